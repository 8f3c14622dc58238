// SPDX-License-Identifier: Apache-2.0
// One step of a single vibration, taken by the stepper itself, against the amplification matrices
// of the literature.
#include <cmath>
#include <map>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector4d;

/// A free bar of one element: its only stretching vibration has ω² = 12 EA/(ρA L²).
class StretchingBar {
 public:
  /// @param alpha Rayleigh damping of the mass, @param beta of the stiffness
  explicit StretchingBar(double omega, double alpha = 0, double beta = 0) {
    test::BeamConstants c;
    c.elements = 1;
    c.EA = omega * omega / 12.0;
    c.EIz = c.EA;
    c.alpha = alpha;
    c.beta = beta;
    test::Mechanism mechanism(spatial::Plane::xy);
    mechanism.add_flexible(test::straight_beam(c, spatial::Plane::xy), body::CouplingLevel::none,
                           {});
    model_ = mechanism.take();
    shape_ = linalg::Vector::Zero(model_.bodies[0].num_dofs());
    const auto& nodes = model_.bodies[0].flexible->fe.dofs.node_dofs;
    shape_[nodes[0][0]] = -1.0;
    shape_[nodes[1][0]] = 1.0;
  }

  /// x, ẋ, ẍ and algorithmic acceleration after one step.
  Vector4d step(const StepSettings& settings, const Vector4d& x) const {
    Stepper stepper(model_, settings, {});
    model::State state = model::placed_state(model_);
    model::BodyState& s = state.bodies[0];
    s.d = x[0] * shape_;
    s.d_dot = x[1] * shape_;
    s.d_ddot = x[2] * shape_;
    s.d_alg = x[3] * shape_;
    stepper.step(state);
    const auto along = [this](const linalg::Vector& v) { return 0.5 * shape_.dot(v); };
    const model::BodyState& end = state.bodies[0];
    return {along(end.d), along(end.d_dot), along(end.d_ddot), along(end.d_alg)};
  }

  Matrix4d amplification(const StepSettings& settings) const {
    Matrix4d A;
    for (int k = 0; k < 4; ++k) A.col(k) = step(settings, Vector4d::Unit(k));
    return A;
  }

 private:
  model::Model model_;
  linalg::Vector shape_;
};

StepSettings unit_step(Method method, double parameter) {
  StepSettings settings;
  settings.method = method;
  settings.step = 1.0;
  settings.rho_inf = settings.alpha = settings.theta = parameter;
  return settings;
}

double spectral_radius(Method method, double parameter, double omega) {
  return StretchingBar(omega)
      .amplification(unit_step(method, parameter))
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

/// Matrices hold numbers up to ω² and come from one factorisation and one solve: about 1e3 ε.
void expect_close(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 2e-13 * expected.cwiseAbs().maxCoeff())
      << found << "\n\n"
      << expected;
}

TEST(Amplification, NewmarkIsTheRotationOfTheTrapezoidalRule) {
  for (const double omega : {0.3, 1.0, 7.0}) {
    const Matrix4d A = StretchingBar(omega).amplification(unit_step(Method::newmark, 0.9));
    const double q = omega * omega / 4;
    Eigen::Matrix2d expected;
    expected << 1 - q, 1, -4 * q, 1 - q;
    expect_close(A.topLeftCorner<2, 2>(), expected / (1 + q));
  }
}

/// Wilson's method as in Bathe, Finite Element Procedures (1996), table 9.3 and section 9.4.2:
/// acts on (ẍ, ẋ, x), h = 1.
Matrix3d wilson_matrix(double theta, double omega, double xi) {
  const double beta =
      1.0 / (theta / (omega * omega) + xi * theta * theta / omega + theta * theta * theta / 6.0);
  const double kappa = xi * beta / omega;
  Matrix3d A;
  A << 1 - beta * theta * theta / 3 - 1 / theta - kappa * theta, -beta * theta - 2 * kappa, -beta,
      1 - 1 / (2 * theta) - beta * theta * theta / 6 - kappa * theta / 2,
      1 - beta * theta / 2 - kappa, -beta / 2,
      0.5 - 1 / (6 * theta) - beta * theta * theta / 18 - kappa * theta / 6,
      1 - beta * theta / 6 - kappa / 3, 1 - beta / 6;
  return A;
}

TEST(Amplification, WilsonHasTheMatrixOfBathe) {
  for (const double theta : {1.37, 1.4, 2.0}) {
    for (const double omega : {0.3, 1.0, 7.0}) {
      for (const double xi : {0.0, 0.1}) {
        // Damping 2 ξ ω: half by mass, half by stiffness.
        const StretchingBar bar(omega, xi * omega, xi / omega);
        const Matrix4d A = bar.amplification(unit_step(Method::wilson, theta));
        // (ẍ, ẋ, x) are rows and columns 2, 1, 0; the algorithmic acceleration plays no part.
        EXPECT_LE(A.col(3).cwiseAbs().maxCoeff(), 1e-15);
        expect_close(A.topLeftCorner<3, 3>().rowwise().reverse().colwise().reverse(),
                     wilson_matrix(theta, omega, xi));
      }
    }
  }
}

/// Hilber, Hughes and Taylor (1977): acts on (x, hẋ, h²a).
Matrix3d hht_matrix(double alpha, double omega) {
  const double beta = (1 - alpha) * (1 - alpha) / 4;
  const double gamma = 0.5 - alpha;
  const double q = omega * omega;
  Matrix3d A;
  A << 1 + alpha * beta * q, 1, 0.5 - beta,              //
      -gamma * q, 1 - (1 + alpha) * (gamma - beta) * q,  //
      1 - gamma - (1 + alpha) * (gamma / 2 - beta) * q,  //
      -q, -(1 + alpha) * q, -(1 + alpha) * (0.5 - beta) * q;
  return A / (1 + (1 + alpha) * beta * q);
}

/// Acts on (x, ẋ, a) if ẍ satisfies the equation of motion.
Matrix3d reduced(const Matrix4d& A, double omega) {
  Matrix3d out;
  const std::array<int, 3> rows = {0, 1, 3};
  for (int i = 0; i < 3; ++i) {
    const int row = rows[static_cast<std::size_t>(i)];
    out.row(i) << A(row, 0) - omega * omega * A(row, 2), A(row, 1), A(row, 3);
  }
  return out;
}

TEST(Amplification, HhtHasItsMatrix) {
  for (const double alpha : {-1.0 / 3.0, -0.1, 0.0}) {
    for (const double omega : {0.3, 1.0, 7.0}) {
      const Matrix4d A = StretchingBar(omega).amplification(unit_step(Method::hht, alpha));
      expect_close(reduced(A, omega), hht_matrix(alpha, omega));
    }
  }
}

TEST(Amplification, GeneralizedAlphaSolvesTheEquationsOfChungAndHulbert) {
  for (const double rho : {0.0, 0.8, 1.0}) {
    for (const double omega : {0.3, 1.0, 7.0}) {
      const double am = (2 * rho - 1) / (rho + 1);
      const double af = rho / (rho + 1);
      const double gamma = 0.5 - am + af;
      const double beta = (1 - am + af) * (1 - am + af) / 4;
      const double q = omega * omega;
      Matrix3d end, start;
      end << 1, 0, -beta, 0, 1, -gamma, (1 - af) * q, 0, 1 - am;
      start << 1, 1, 0.5 - beta, 0, 1, 1 - gamma, -af * q, 0, -am;
      const Matrix4d A =
          StretchingBar(omega).amplification(unit_step(Method::generalized_alpha, rho));
      expect_close(reduced(A, omega), end.inverse() * start);
    }
  }
}

TEST(Amplification, SpectralRadiiAsTabulated) {
  // Numbers of an independent calculation, rounded to the digits given.
  struct Row {
    Method method;
    double parameter;
    std::map<double, double> radius;
    double rounding;
  };
  const std::vector<Row> rows = {
      {Method::wilson,
       1.4,
       {{0.5, 0.99616}, {1.0, 0.967}, {3.0, 0.762}, {10.0, 0.562}, {1000.0, 0.778}},
       6e-4},
      {Method::wilson, 1.37, {{1000.0, 0.976}}, 6e-4},
      {Method::generalized_alpha,
       0.8,
       {{0.5, 0.99996}, {1.0, 0.9995}, {3.0, 0.987}, {10.0, 0.930}, {1000.0, 0.808}},
       6e-4},
      {Method::newmark, 0.9, {{0.01, 1.0}, {1.0, 1.0}, {1000.0, 1.0}}, 1e-7},
      // High frequencies: (1 + α)/(1 − α).
      {Method::hht, -0.1, {{0.01, 1.0}, {1e5, 0.9 / 1.1}}, 1e-6},
      // A double root there: it shows rounding ε ω² as its square root.
      {Method::hht, -1.0 / 3.0, {{0.01, 1.0}, {1e5, 0.5}}, 1e-3},
      {Method::hht, 0.0, {{0.01, 1.0}, {1000.0, 1.0}}, 1e-5}};
  for (const Row& row : rows) {
    for (const auto& [omega, radius] : row.radius) {
      EXPECT_NEAR(spectral_radius(row.method, row.parameter, omega), radius, row.rounding)
          << to_string(row.method) << ' ' << row.parameter << ' ' << omega;
    }
  }
}

}  // namespace
}  // namespace buckens::stepping
