// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/scheme.h"

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::stepping {
namespace {

/// An undamped or damped oscillator ẍ + 2δẋ + ω²x = 0, stepped by the relations of a scheme.
struct Oscillator {
  double omega, delta;
  Eigen::Vector4d step(const Scheme& scheme, const Eigen::Vector4d& x) const {
    // x, ẋ, ẍ, algorithmic
    const History<double> history = scheme.history(x[1], x[2], x[3]);
    const double K_hat =
        scheme.mass + scheme.damping * 2 * delta + scheme.stiffness * omega * omega;
    const double rest =
        history.acceleration + 2 * delta * history.mean_velocity + omega * omega * x[0];
    const double change = -scheme.force * rest / K_hat;
    const double acceleration = scheme.acceleration_rate * change + history.acceleration;
    return {x[0] + change, scheme.end_rate * change + history.velocity, acceleration,
            scheme.algorithmic(x[2], x[3], acceleration)};
  }
  /// Moduli of the amplification, from the action on unit states.
  double spectral_radius(const Scheme& scheme) const {
    Eigen::Matrix4d A;
    for (int k = 0; k < 4; ++k) A.col(k) = step(scheme, Eigen::Vector4d::Unit(k));
    return A.eigenvalues().cwiseAbs().maxCoeff();
  }
};

TEST(Scheme, NewmarkIsTheTrapezoidalRule) {
  const double h = 0.1;
  const Scheme scheme(Method::newmark, h, 0.9);
  EXPECT_DOUBLE_EQ(scheme.mass, 1.0);
  EXPECT_DOUBLE_EQ(scheme.damping, h / 2);
  EXPECT_DOUBLE_EQ(scheme.stiffness, h * h / 4);
  EXPECT_DOUBLE_EQ(scheme.evaluation_time(2.0), 2.05);
  // x⁺ = x + h (ẋ + ẋ⁺)/2, and the mean acceleration is the change of rate over h.
  const History<double> history = scheme.history(0.7, 0.3, 0.3);
  const double change = 0.11;
  const double rate = scheme.end_rate * change + history.velocity;
  EXPECT_NEAR(change, h * (0.7 + rate) / 2, 1e-16);
  EXPECT_NEAR(scheme.acceleration_rate * change + history.acceleration, (rate - 0.7) / h, 1e-13);
  EXPECT_NEAR(scheme.mean_rate * change + history.mean_velocity, (rate + 0.7) / 2, 1e-15);
}

TEST(Scheme, GeneralizedAlphaHasTheCoefficientsOfChungAndHulbert) {
  const double h = 0.1;
  const double rho = 0.8;
  const Scheme scheme(Method::generalized_alpha, h, rho);
  const double alpha_m = (2 * rho - 1) / (rho + 1);
  const double alpha_f = rho / (rho + 1);
  const double gamma = 0.5 + alpha_f - alpha_m;
  const double beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
  EXPECT_DOUBLE_EQ(scheme.force, beta * h * h);
  EXPECT_DOUBLE_EQ(scheme.mass, (1 - alpha_m) / (1 - alpha_f));
  EXPECT_DOUBLE_EQ(scheme.damping, gamma * h);
  EXPECT_DOUBLE_EQ(scheme.stiffness, beta * h * h);
  EXPECT_NEAR(scheme.algorithmic_offset(), alpha_m - alpha_f, 1e-16);
  EXPECT_DOUBLE_EQ(scheme.evaluation_time(2.0), 2.1);
  // Increments of constant acceleration are exact.
  const History<double> history = scheme.history(0.7, 0.3, 0.3);
  const double change = 0.7 * h + 0.15 * h * h;
  EXPECT_NEAR(history.predicted, change, 1e-16);
  EXPECT_NEAR(scheme.end_rate * change + history.velocity, 0.73, 1e-14);
  EXPECT_NEAR(scheme.acceleration_rate * change + history.acceleration, 0.3, 1e-12);
  EXPECT_NEAR(scheme.algorithmic(0.3, 0.3, 0.3), 0.3, 1e-15);
}

TEST(Scheme, DampsAsDesigned) {
  // Spectral radius: Newmark 1 everywhere; generalised-α near 1 for low and ρ∞ for high
  // frequencies.
  for (const double omega_h : {0.01, 1.0, 100.0}) {
    const Oscillator oscillator{omega_h, 0.0};
    EXPECT_NEAR(oscillator.spectral_radius(Scheme(Method::newmark, 1.0, 0.9)), 1.0, 1e-7);
  }
  for (const double rho : {0.0, 0.5, 0.8, 0.9, 1.0}) {
    const Scheme scheme(Method::generalized_alpha, 1.0, rho);
    EXPECT_NEAR((Oscillator{1e6, 0.0}.spectral_radius(scheme)), rho, 1e-3) << rho;
    EXPECT_NEAR((Oscillator{0.01, 0.0}.spectral_radius(scheme)), 1.0, 1e-6) << rho;
  }
  // Tabulated for ρ∞ = 0.8 at ωh = 1, 3, 10.
  const Scheme scheme(Method::generalized_alpha, 1.0, 0.8);
  EXPECT_NEAR((Oscillator{1.0, 0.0}.spectral_radius(scheme)), 0.9995, 1e-4);
  EXPECT_NEAR((Oscillator{3.0, 0.0}.spectral_radius(scheme)), 0.987, 1e-3);
  EXPECT_NEAR((Oscillator{10.0, 0.0}.spectral_radius(scheme)), 0.930, 1e-3);
}

TEST(Scheme, ConvergesWithOrderTwo) {
  const Oscillator oscillator{3.0, 0.4};
  for (const Method method : {Method::newmark, Method::generalized_alpha}) {
    std::array<double, 2> error{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = k == 0 ? 0.01 : 0.005;
      const Scheme scheme(method, h, 0.9);
      Eigen::Vector4d x(1.0, 0.0, -9.0, -9.0);
      const long steps = std::lround(1.0 / h);
      for (long i = 0; i < steps; ++i) x = oscillator.step(scheme, x);
      const double nu = std::sqrt(9.0 - 0.16);
      const double exact = std::exp(-0.4) * (std::cos(nu) + 0.4 / nu * std::sin(nu));
      error[k] = std::abs(x[0] - exact);
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05) << to_string(method);
  }
}

TEST(Scheme, VelocitiesMoveByTheMeanOfAlgorithmicAccelerations) {
  const double h = 0.1;
  for (const Scheme& scheme :
       {Scheme(Method::generalized_alpha, h, 0.6), Scheme(Method::hht, h, -0.2),
        Scheme(Method::newmark, h, 0.0), Scheme(Method::wilson, h, 1.5)}) {
    const double rate = 0.3, acceleration = -2.0, change = 0.07;
    const double algorithmic = scheme.has_algorithmic() ? -1.3 : acceleration;
    const History<double> history = scheme.history(rate, acceleration, algorithmic);
    const double end_rate = scheme.end_rate * change + history.velocity;
    const double carried = scheme.carried_acceleration(
        acceleration, scheme.acceleration_rate * change + history.acceleration);
    const double after = scheme.algorithmic(acceleration, algorithmic, carried);
    const double s = scheme.share_of_end();
    EXPECT_NEAR(end_rate - rate, h * ((1.0 - s) * algorithmic + s * after), 1e-14)
        << to_string(scheme.method);
  }
}

TEST(Scheme, RefusesWhatIsNoStep) {
  EXPECT_THROW(Scheme(Method::newmark, 0.0, 0.9), InputError);
  EXPECT_THROW(Scheme(Method::newmark, std::numeric_limits<double>::quiet_NaN(), 0.9), InputError);
  EXPECT_THROW(Scheme(Method::generalized_alpha, 0.1, 1.1), InputError);
}

}  // namespace
}  // namespace buckens::stepping
