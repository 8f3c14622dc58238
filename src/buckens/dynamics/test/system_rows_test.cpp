// SPDX-License-Identifier: Apache-2.0
// Joint rows, forces and their condensation over whole mechanisms.
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/joints/swing_twist.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::dynamics {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using linalg::Matrix;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Numbers in general position.
double some(double seed) { return std::sin(1.0 + 2.3 * seed); }

/// Constant rates of frames and interface values along which the mechanism is moved.
struct Motions {
  std::vector<BodyMotion> start;
  std::vector<Vector6> rate;

  explicit Motions(const model::Model& model) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const double s = static_cast<double>(b);
      BodyMotion motion;
      motion.frame.X_WB = model.placed[b];
      motion.frame.X_WB.p += 0.1 * Vector3d(some(s), some(s + 1), some(s + 2));
      motion.frame.X_WB.q = spatial::exp_rotation(0.2 * Vector3d(some(s + 3), some(s + 4), 0.5)) *
                            motion.frame.X_WB.q;
      const Eigen::Index rows = model.bodies[b].num_interface_rows();
      motion.y.resize(rows);
      motion.y_dot.resize(rows);
      for (Eigen::Index k = 0; k < rows; ++k) {
        motion.y[k] = 0.1 * some(5 + s + static_cast<double>(k));
        motion.y_dot[k] = some(9 + s + 3 * static_cast<double>(k));
      }
      Vector6 u;
      for (int k = 0; k < 6; ++k) u[k] = some(20 + s + 2 * k);
      motion.frame.w = u.head<3>();
      motion.frame.v = u.tail<3>();
      start.push_back(motion);
      rate.push_back(u);
    }
  }

  std::vector<BodyMotion> at(double t) const {
    std::vector<BodyMotion> out = start;
    for (std::size_t b = 0; b < out.size(); ++b) {
      out[b].frame.X_WB.p += t * rate[b].tail<3>();
      out[b].frame.X_WB.q = start[b].frame.X_WB.q * spatial::exp_rotation(t * rate[b].head<3>());
      out[b].y += t * start[b].y_dot;
    }
    return out;
  }
};

constexpr double kTime = 0.004;

Vector residual(const model::Model& model, const std::vector<BodyMotion>& motions, double t) {
  Constraints constraints;
  evaluate_constraints(model, motions, t, constraints);
  return constraints.g;
}

TEST(SystemRows, RatesAreThoseOfTheResiduals) {
  const model::Model model = test::slider_crank(2);
  const Motions path(model);
  Constraints constraints;
  evaluate_constraints(model, path.start, kTime, constraints);
  const Vector expected =
      test::derivative([&](double t) { return residual(model, path.at(t), kTime + t); }, 1e-5);
  // The drive turns at 150 rad/s: truncation (150 h)⁴, rounding ε/h.
  EXPECT_LE((constraints.g_dot - expected).norm(), 1e-9 * expected.norm());
  const Vector moving =
      test::derivative([&](double t) { return residual(model, path.at(t), kTime); }, 1e-4);
  for (Eigen::Index k = 0; k < moving.size(); ++k) {
    const SystemRow& row = constraints.rows[static_cast<std::size_t>(k)];
    double rate = 0;
    for (const BodyRow* share : {&row.first, &row.second}) {
      if (share->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(share->body);
      EXPECT_NEAR(share->change(path.rate[b], path.start[b].y_dot), share->rate(path.start[b]),
                  1e-14);
      rate += share->rate(path.start[b]);
    }
    EXPECT_NEAR(rate, moving[k], 1e-9) << k;
  }
}

TEST(SystemRows, BiasIsTheAccelerationWithoutThatOfTheCoordinates) {
  const model::Model model = test::slider_crank(2);
  const Motions path(model);
  const Vector expected = test::second_derivative(
      [&](double t) { return residual(model, path.at(t), kTime + t); }, 5e-5);
  const Vector bias = constraint_bias(model, path.start, kTime);
  // Rounding ε/h² = 1e-7 beside accelerations of 150² = 2e4.
  EXPECT_LE((bias - expected).norm(), 1e-8 * expected.norm());
}

/// Two rods on a ball joint whose swing and twist follow laws of time.
model::Model driven_ball() {
  test::Mechanism m;
  const Eigen::Quaterniond turned = spatial::exp_rotation(Vector3d(0.3, -0.4, 0.7));
  const int upper = test::add_rod(m, 1.0, 1.0, {{0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  const int lower = test::add_rod(m, 1.0, 1.0, {{1.5, 0, 0}, turned});
  m.add_joint(joints::JointType::spherical, m.rigid_marker(upper, {0.5, 0, 0}),
              m.rigid_marker(lower, {-0.5, 0, 0}));
  const Vector3d x = Vector3d::UnitX();
  const auto law = [](const char* formula) {
    return base::TimeLaw::expression(base::Expression(formula, {"t"}, {}, {}));
  };
  const auto swing = std::make_shared<joints::Swing>(x, x);
  const auto twist = std::make_shared<joints::Twist>(x, x, turned.toRotationMatrix());
  m.add_coupler({{m.add_coordinate(0, joints::JointCoordinate::measured(swing)), {}}},
                law("0.3 + 20*t^2"));
  m.add_coupler({{m.add_coordinate(0, joints::JointCoordinate::measured(twist)), {}}},
                law("sin(30*t)"));
  return m.take();
}

TEST(SystemRows, DrivesOfCoordinatesHaveRatesAndBias) {
  const model::Model model = driven_ball();
  const Motions path(model);
  const auto moving = [&](double t) { return residual(model, path.at(t), kTime + t); };
  Constraints constraints;
  evaluate_constraints(model, path.start, kTime, constraints);
  EXPECT_GT(constraints.g_t.tail(2).cwiseAbs().minCoeff(), 0.1);
  // Rounding ε/h and ε/h², and h⁴ of motions with some 30 rad/s.
  const Vector rates = test::derivative(moving, 1e-4);
  EXPECT_LE((constraints.g_dot - rates).norm(), 1e-9 * (1 + rates.norm()));
  const Vector bias = test::second_derivative(moving, 5e-4);
  EXPECT_LE((constraint_bias(model, path.start, kTime) - bias).norm(), 1e-7 * (1 + bias.norm()));
}

TEST(SystemForces, PowerIsLossOfStoredEnergyAndActivePower) {
  test::BeamConstants beam;
  beam.elements = 2;
  const model::Model model = test::bushed_beam(beam);
  const Motions path(model);
  Forces forces;
  evaluate_forces(model, path.start, 0.0, forces);
  double power = 0;
  double gravity = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    power += forces.frame[b].dot(path.rate[b]);
    gravity += model.bodies[b].mass * model.gravity.dot(path.start[b].frame.v);
    if (model.bodies[b].is_flexible()) power += forces.interface[b].dot(path.start[b].y_dot);
  }
  const double energy_rate = test::derivative([&](double t) {
    Forces moved;
    evaluate_forces(model, path.at(t), 0.0, moved);
    return moved.stored_energy;
  });
  EXPECT_NEAR(power, gravity + forces.active_power - energy_rate,
              1e-8 * (std::abs(energy_rate) + std::abs(forces.active_power)));
}

TEST(SystemForces, JointForcesDoTheWorkOfTheResiduals) {
  const model::Model model = test::slider_crank(2);
  const Motions path(model);
  Constraints constraints;
  evaluate_constraints(model, path.start, 0.0, constraints);
  Vector lambda(model.num_constraint_rows());
  for (Eigen::Index k = 0; k < lambda.size(); ++k) lambda[k] = some(static_cast<double>(k));
  Forces forces;
  forces.reset(model);
  add_joint_forces(constraints, lambda, forces);
  double power = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    power += forces.frame[b].dot(path.rate[b]);
    if (model.bodies[b].is_flexible()) power += forces.interface[b].dot(path.start[b].y_dot);
  }
  const Vector rates =
      test::derivative([&](double t) { return residual(model, path.at(t), 0.0); }, 1e-4);
  EXPECT_NEAR(power, lambda.dot(rates), 1e-9);  // no gravity in this model
}

/// The same matrix from dense blocks: all rows over all frame and interface coordinates.
Matrix dense(const model::Model& model, const std::vector<SystemRow>& rows) {
  std::vector<Eigen::Index> first;
  Eigen::Index columns = 0;
  for (const body::Body& body : model.bodies) {
    first.push_back(columns);
    columns += 6 + body.num_interface_rows();
  }
  Matrix J = Matrix::Zero(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    for (const BodyRow* share : {&rows[r].first, &rows[r].second}) {
      if (share->body == model::kGround) continue;
      const Eigen::Index start = first[static_cast<std::size_t>(share->body)];
      J.block<1, 6>(row, start) += share->frame;
      if (share->translation_row >= 0) {
        J.block<1, 3>(row, start + 6 + share->translation_row) += share->interface.head<3>();
      }
      if (share->rotation_row >= 0) {
        J.block<1, 3>(row, start + 6 + share->rotation_row) += share->interface.tail<3>();
      }
    }
  }
  return J;
}

/// Solutions with slopes are those of the matrix S′, eq. (R21).
void expect_slopes(const MultiplierCondensation& condensation, Matrix S,
                   const std::vector<double>& soft, const std::vector<MultiplierSlope>& slopes,
                   const Vector& x, double accuracy) {
  for (const MultiplierSlope& slope : slopes) {
    const auto own = static_cast<std::size_t>(slope.soft_row - (S.rows() - std::ssize(soft)));
    S(slope.soft_row, slope.row) -= soft[own] * slope.value;
  }
  Vector found = S * x;
  condensation.solve_with_slopes(found);
  EXPECT_LE((found - x).norm(), accuracy * x.norm());
}

/// @param expected loads on the coordinates of all bodies by multipliers x
void expect_gathered(const model::Model& model, const MultiplierCondensation& condensation,
                     const Vector& expected, const Vector& x) {
  std::vector<BodyResponse> loads(model.bodies.size());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    loads[k].interface_load = VectorXd::Zero(model.bodies[k].num_interface_rows());
  }
  condensation.gather(x, loads);
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    EXPECT_LE((loads[k].frame_load - expected.segment<6>(at)).norm(), 1e-13 * expected.norm());
    at += 6;
    const Eigen::Index rows = loads[k].interface_load.size();
    EXPECT_LE((loads[k].interface_load - expected.segment(at, rows)).norm(),
              1e-13 * expected.norm());
    at += rows;
  }
}

/// @param sign of the frames' compliance: −1 leaves no matrix that is nearly positive definite
/// @param slopes of soft rows with multipliers
/// @param num_empty soft rows before the last two that act on nothing
void expect_the_dense_matrix(double sign, int num_loose = 0, double accuracy = 1e-14,
                             const std::vector<MultiplierSlope>& slopes = {}, int num_empty = 0) {
  const model::Model model = test::slider_crank(2);
  const Motions path(model);
  Constraints closed, acting;
  evaluate_constraints(model, path.start, kTime, closed);
  evaluate_constraints(model, path.at(0.1), kTime, acting);  // other directions than tested
  const MassMetric metric(model);
  std::vector<Eigen::Matrix3d> J0;
  for (const body::Body& body : model.bodies) J0.push_back(body.J0);
  std::vector<BodyCompliance> compliance = metric.full(J0);
  for (BodyCompliance& body : compliance) body.frame *= sign;

  Eigen::Index columns = 0;
  for (const body::Body& body : model.bodies) columns += 6 + body.num_interface_rows();
  Matrix C = Matrix::Zero(columns, columns);
  Eigen::Index at = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    C.block<6, 6>(at, at) = compliance[b].frame;
    at += 6;
    const Eigen::Index rows = model.bodies[b].num_interface_rows();
    if (rows > 0) C.block(at, at, rows, rows) = *compliance[b].interface;
    at += rows;
  }
  MultiplierCondensation condensation(static_cast<int>(model.bodies.size()), closed.rows,
                                      num_loose);
  std::vector<double> soft = {0.3, 0.7};  // of the last two rows
  for (int k = 0; k < num_empty; ++k) {
    const std::size_t row = closed.rows.size() - 3 - static_cast<std::size_t>(k);
    closed.rows[row] = acting.rows[row] = SystemRow{};
    soft.insert(soft.begin(), 0.5 + k);
  }
  Matrix S = dense(model, closed.rows) * C * dense(model, acting.rows).transpose();
  S.diagonal().tail(std::ssize(soft)) += Vector::Map(soft.data(), std::ssize(soft));

  condensation.set_slopes(slopes);
  ASSERT_TRUE(condensation.factorise(closed.rows, acting.rows, compliance, soft));
  // A second time into the same memory.
  ASSERT_TRUE(condensation.factorise(closed.rows, acting.rows, compliance, soft));
  // A share of the diagonal; one of the largest pivot would depend on units.
  EXPECT_EQ(condensation.pivot_ratio() > 1e-6, sign > 0.0);
  Vector x(S.rows());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = some(static_cast<double>(k));
  const Vector b = S * x;
  Vector found = b;
  condensation.solve_in_place(found);
  const auto singular = S.jacobiSvd().singularValues();
  const double condition = singular[0] / singular[singular.size() - 1];
  EXPECT_LE((found - x).norm(), accuracy * condition * x.norm());

  expect_slopes(condensation, S, soft, slopes, x, accuracy * condition);
  expect_gathered(model, condensation, dense(model, acting.rows).transpose() * x, x);
}

TEST(MultiplierCondensation, EqualsTheDenseMatrix) { expect_the_dense_matrix(1.0); }

TEST(MultiplierCondensation, CountsHowSoftRowsGrowWithMultipliers) {
  // The two rows of the guide as soft ones, growing with those of the pin of the slider.
  const int rows = test::slider_crank(2).num_constraint_rows();
  const std::vector<MultiplierSlope> of_first = {{rows - 2, rows - 4, 0.4},
                                                 {rows - 2, rows - 3, 0.2}};
  std::vector<MultiplierSlope> of_both = of_first;
  of_both.push_back({rows - 1, rows - 3, -0.3});
  expect_the_dense_matrix(1.0, 0, 1e-14, of_both);
  expect_the_dense_matrix(1.0, 1, 1e-10, of_first);
}

TEST(MultiplierCondensation, IteratesWithRowsThatAreNotFactorised) {
  // The residual at which the iteration ends.
  expect_the_dense_matrix(1.0, 1, 1e-10);
  expect_the_dense_matrix(1.0, 2, 1e-10);
}

TEST(MultiplierCondensation, ExchangesRowsWherePivotsArePoor) { expect_the_dense_matrix(-1.0); }

TEST(MultiplierCondensation, LeavesOutRowsThatActOnNothing) {
  const int rows = test::slider_crank(2).num_constraint_rows();
  for (const int num_empty : {1, 3, 5}) {
    expect_the_dense_matrix(1.0, 0, 1e-14, {}, num_empty);
    expect_the_dense_matrix(1.0, 0, 1e-14, {{rows - 2, rows - 1, 0.4}}, num_empty);
    expect_the_dense_matrix(1.0, 1, 1e-10, {}, num_empty);
    expect_the_dense_matrix(-1.0, 0, 1e-14, {}, num_empty);
  }
}

}  // namespace
}  // namespace buckens::dynamics
