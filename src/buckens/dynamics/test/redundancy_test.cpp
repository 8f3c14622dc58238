// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/dynamics/test/mechanism.h"

namespace buckens::dynamics {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

/// A door of 20 kg on two hinges about z, at z = ±1 m; its mass centre lies half a metre off.
model::Model door() {
  test::Mechanism m;
  m.set_gravity({0, 0, -9.81});
  m.set_length(2.0);
  const int leaf = m.add_rigid(20.0, Vector3d(7.0, 8.4, 1.7).asDiagonal(),
                               {{0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  for (const double z : {-1.0, 1.0}) {
    m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, z}),
                m.rigid_marker(leaf, {-0.5, 0, z}));
  }
  return m.take();
}

class Door : public testing::Test {
 protected:
  Door() : model(door()), metric(model) {
    evaluate_constraints(model, motions_of(model, model::placed_state(model)), 0.0, constraints);
    G = Matrix::Zero(10, 6);
    for (Eigen::Index k = 0; k < 10; ++k) {
      G.row(k) = constraints.rows[static_cast<std::size_t>(k)].second.frame;
    }
  }
  model::Model model;
  MassMetric metric;
  Constraints constraints;
  Matrix G;  // rows over the frame of the leaf
};

TEST_F(Door, FiveRowsOfTenFollowFromTheOthers) {
  const linalg::RowRank split = metric.split(constraints.rows);
  EXPECT_EQ(split.independent.size(), 5U);
  EXPECT_EQ(split.dependent.size(), 5U);
  Matrix kept(5, 6);
  for (std::size_t k = 0; k < 5; ++k) {
    kept.row(static_cast<Eigen::Index>(k)) = G.row(split.independent[k]);
  }
  EXPECT_EQ(kept.fullPivLu().rank(), 5);
}

TEST_F(Door, TheLeastMultipliersShareTheLoadEvenly) {
  // The forces that hold the leaf: its weight upwards at the hinges' line.
  Eigen::Matrix<double, 6, 1> needed;
  needed << 0, 0, 0, 0, 0, 20 * 9.81;
  const linalg::RowRank split = metric.split(constraints.rows);
  Matrix kept(5, 6);
  for (std::size_t k = 0; k < 5; ++k) {
    kept.row(static_cast<Eigen::Index>(k)) = G.row(split.independent[k]);
  }
  const Vector some = kept.transpose().colPivHouseholderQr().solve(Vector(needed));
  ASSERT_LE((kept.transpose() * some - needed).norm(), 1e-12 * needed.norm());
  Vector lambda = Vector::Zero(10);
  for (std::size_t k = 0; k < 5; ++k) {
    lambda[split.independent[k]] = some[static_cast<Eigen::Index>(k)];
  }

  const Vector least = least_multipliers(model, metric, constraints.rows, lambda);
  EXPECT_LE((G.transpose() * least - needed).norm(), 1e-12 * needed.norm());
  // Rows per hinge: force x, y, z, then two torques. Both hinges carry half of the weight, the same
  // torque, and opposite forces along x.
  const Vector lower = least.head<5>();
  const Vector upper = least.tail<5>();
  EXPECT_NEAR(lower[2], 0.5 * needed[5], 1e-11 * needed[5]);
  EXPECT_NEAR(upper[2], 0.5 * needed[5], 1e-11 * needed[5]);
  EXPECT_NEAR(lower[0], -upper[0], 1e-11 * needed[5]);
  EXPECT_LE((lower.tail<2>() - upper.tail<2>()).norm(), 1e-11 * needed[5]);
  // The minimum of Σ F² + Σ (M/L)² under 2 F + 2 M = 0.5 m g: F = 0.25 m g /(1 + L²) …
  const double moment = 0.5 * 20 * 9.81;
  const double weight = 1.0 + model.length * model.length;
  EXPECT_NEAR(std::abs(lower[0]), 0.5 * moment / weight, 1e-11 * needed[5]);
  EXPECT_NEAR(lower.tail<2>().norm(), 0.5 * moment * (1.0 - 1.0 / weight), 1e-11 * needed[5]);
}

TEST_F(Door, MultipliersThatAreUniqueStay) {
  test::Mechanism m;
  const int leaf = m.add_rigid(20.0, Eigen::Matrix3d::Identity(), {});
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({1, 0, 0}),
              m.rigid_marker(leaf, {1, 0, 0}));
  const model::Model single = m.take();
  const MassMetric single_metric(single);
  Constraints rows;
  evaluate_constraints(single, motions_of(single, model::placed_state(single)), 0.0, rows);
  Vector lambda(5);
  lambda << 3, -1, 4, 1, -5;
  EXPECT_LE((least_multipliers(single, single_metric, rows.rows, lambda) - lambda).norm(), 1e-12);
}

/// Links on a circle of 10 m in the x–y plane, each hinged to the next about z: closed, so that
/// three equations follow from the others.
model::Model ring(int links) {
  test::Mechanism m;
  m.set_length(20.0);
  const double half = 10.0 * std::tan(M_PI / links);
  const auto turn = [&](int k) { return 2.0 * M_PI * k / links; };
  for (int k = 0; k < links; ++k) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(turn(k), Vector3d::UnitZ()));
    m.add_rigid(0.1, Vector3d(1e-4, 1e-3, 1e-3).asDiagonal(), {q * Vector3d(10, 0, 0), q});
  }
  for (int k = 0; k < links; ++k) {
    m.add_joint(joints::JointType::revolute, m.rigid_marker(k, {0, half, 0}),
                m.rigid_marker((k + 1) % links, {0, -half, 0}));
  }
  return m.take();
}

TEST(Ring, MultipliersOfManyLinksAreTheLeast) {
  // 3000 rows. Forces of the same image differ by what is perpendicular to all least ones.
  const model::Model model = ring(600);
  const MassMetric metric(model);
  Constraints constraints;
  evaluate_constraints(model, motions_of(model, model::placed_state(model)), 0.0, constraints);
  const linalg::SparseMatrix J = metric.weighted_jacobian(constraints.rows);
  Vector lambda(J.rows()), other(J.rows()), weight(J.rows());
  for (Eigen::Index k = 0; k < J.rows(); ++k) {
    lambda[k] = std::sin(1.0 + 1.7 * static_cast<double>(k));
    other[k] = std::cos(0.4 * static_cast<double>(k));
    const bool is_force = k % 5 < 3;  // three forces of a hinge, then two torques
    weight[k] = is_force ? 1.0 : 1.0 / (model.length * model.length);
  }
  const Vector least = least_multipliers(model, metric, constraints.rows, lambda);
  const Vector least_other = least_multipliers(model, metric, constraints.rows, other);
  // Rounding times the condition of the ring, the square of its 600 links.
  EXPECT_LE((J.transpose() * (least - lambda)).norm(), 1e-10 * (J.transpose() * lambda).norm());
  EXPECT_GT((least - lambda).norm(), 1e-3 * lambda.norm()) << "there was something to leave out";
  EXPECT_LE(std::abs((lambda - least).dot(weight.cwiseProduct(least_other))),
            1e-10 * lambda.squaredNorm());
}

}  // namespace
}  // namespace buckens::dynamics
