// SPDX-License-Identifier: Apache-2.0
// Vibrations of assembled systems against closed forms and second routes.
#include "buckens/analysis/vibration/system_vibration.h"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/analysis/test/static_models.h"
#include "buckens/analysis/vibration/body_vibration.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {
namespace {

using test::at_marker;
using test::ground_at;
using test::Mechanism;

constexpr double kGravity = 9.81;
constexpr double kIy = 0.02 * 0.03 * 0.03 * 0.03 / 12;

std::vector<double> omegas(const VibrationReport& report) {
  std::vector<double> out;
  for (const Vibration& v : report.vibrations) out.push_back(2 * M_PI * v.frequency);
  return out;
}

VibrationReport vibrate(const Mechanism& m, int count, RestPosition about = RestPosition::initial) {
  const auto built = m.build();
  return system_vibrations(*built, {.count = count, .about = about});
}

TEST(SystemVibration, CantileverHasItsFrequenciesAndEffectiveMasses) {
  const double L = 2.0;
  Mechanism m;
  m.beam("beam", L, 16);
  m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  const VibrationReport report = vibrate(m, 10);
  EXPECT_EQ(report.rigid_modes, 0);
  const auto omega = omegas(report);
  const double weak = std::sqrt(test::kE * test::kIz / test::kRhoA) / (L * L);
  const double strong = std::sqrt(test::kE * kIy / test::kRhoA) / (L * L);
  // cos βL cosh βL = −1. Discretisation (βh)⁴/1440: 1e-7 for the first, 3e-5 for the third.
  const std::vector<double> beta = {1.8751040687119611, 4.6940911329741746, 7.8547574382376126};
  EXPECT_NEAR(omega[0], beta[0] * beta[0] * weak, 1e-6 * omega[0]);
  EXPECT_NEAR(omega[1], beta[0] * beta[0] * strong, 1e-6 * omega[1]);
  EXPECT_NEAR(omega[2], beta[1] * beta[1] * weak, 1e-5 * omega[2]);
  EXPECT_NEAR(omega[3], beta[1] * beta[1] * strong, 1e-5 * omega[3]);
  EXPECT_NEAR(omega[4], beta[2] * beta[2] * weak, 1e-4 * omega[4]);
  // Effective masses of a cantilever: 61.31 %, 18.83 %, 6.47 % of its mass.
  const double mass = test::kRhoA * L;
  EXPECT_NEAR(report.mass, mass, 1e-12 * mass);
  EXPECT_NEAR(report.vibrations[0].effective_mass[1] / mass, 0.61308, 2e-5);
  EXPECT_NEAR(report.vibrations[1].effective_mass[2] / mass, 0.61308, 2e-5);
  EXPECT_NEAR(report.vibrations[2].effective_mass[1] / mass, 0.18830, 2e-5);
  EXPECT_NEAR(report.vibrations[4].effective_mass[1] / mass, 0.06474, 5e-5);
  EXPECT_NEAR(report.vibrations[0].effective_mass[0] / mass, 0.0, 1e-10);
  // A cantilever's modes hold a quarter of its mass against the tip.
  EXPECT_NEAR(report.vibrations[0].generalised_mass / mass, 0.25, 1e-6);
  for (const Vibration& v : report.vibrations) {
    EXPECT_LE(v.error, 1e-7);
    EXPECT_NEAR(v.energy_shares[0], 1.0, 1e-12);
  }
}

TEST(SystemVibration, TwoBodiesFixedTogetherAreOne) {
  Mechanism one, two;
  one.beam("beam", 2.0, 8);
  one.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  two.beam("near", 1.2, 5, {0, 0, 0});
  two.beam("far", 0.8, 3, {1.2, 0, 0});
  two.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("near/start"));
  two.joint<joints::FixedSpec>("weld", at_marker("near/end"), at_marker("far/start"));
  // Elements of 0.24 and 0.2667 m instead of 0.25 m: discretisation differs; the same mesh does
  // not.
  Mechanism same;
  same.beam("near", 1.25, 5, {0, 0, 0});
  same.beam("far", 0.75, 3, {1.25, 0, 0});
  same.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("near/start"));
  same.joint<joints::FixedSpec>("weld", at_marker("near/end"), at_marker("far/start"));
  const auto reference = omegas(vibrate(one, 8));
  const auto other = omegas(vibrate(two, 8));
  const auto equal = omegas(vibrate(same, 8));
  ASSERT_EQ(equal.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(equal[k], reference[k], 1e-9 * reference[k]) << k;
    EXPECT_NEAR(other[k], reference[k], 2e-4 * reference[k]) << k;
  }
}

TEST(SystemVibration, SeveralFramesCarryTheSameVibrations) {
  const auto model = [](int frames) {
    Mechanism m;
    m.beam("beam", 2.0, 8);
    m.description.bodies.back().frames.count = frames;
    m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
    return m;
  };
  const VibrationReport one = vibrate(model(1), 6);
  const VibrationReport four = vibrate(model(4), 6);
  ASSERT_EQ(four.vibrations.size(), 6U);
  EXPECT_EQ(four.energy_groups, one.energy_groups);
  const auto built = model(4).build();
  const VibrationReport free_one = free_body_vibrations(*model(1).build(), 0, {.count = 6});
  const VibrationReport free_four = free_body_vibrations(*built, 0, {.count = 6});
  for (std::size_t k = 0; k < 6; ++k) {
    const double f = one.vibrations[k].frequency;
    EXPECT_NEAR(four.vibrations[k].frequency, f, 1e-8 * f) << k;
    EXPECT_NEAR(four.vibrations[k].effective_mass[1], one.vibrations[k].effective_mass[1],
                1e-7 * one.mass);
    const double g = free_one.vibrations[k].frequency;
    EXPECT_NEAR(free_four.vibrations[k].frequency, g, 1e-10 * g) << k;
  }
}

TEST(SystemVibration, BeamOnTwoHingesHasSineModes) {
  Mechanism m({0, 0, 0});
  m.planar();
  m.beam("beam", 1.5, 12);
  m.joint<joints::RevoluteSpec>("left", at_marker("ground"), at_marker("beam/start"));
  m.rigid_rod("link", 0.5, 1e-3, {1.5, 0, 0}, -M_PI / 2);
  m.joint<joints::RevoluteSpec>("right", at_marker("beam/end"), at_marker("link/s"));
  m.joint<joints::RevoluteSpec>("foot", ground_at({1.5, -0.5, 0}), at_marker("link/e"));
  const auto omega = omegas(vibrate(m, 2));
  for (std::size_t k = 0; k < 2; ++k) {
    const double beta = M_PI * static_cast<double>(k + 1) / 1.5;
    const double exact = beta * beta * std::sqrt(test::kE * test::kIz / test::kRhoA);
    EXPECT_NEAR(omega[k], exact, 6e-5 * exact) << k;  // (βh)⁴/1440 = 5.2e-5 for the second
  }
}

TEST(SystemVibration, RigidPendulumSwingsAboutItsEquilibrium) {
  Mechanism m;
  m.planar();
  m.rigid_rod("rod", 0.8, 2.0, {0, 0, 0}, -1.0);  // found from an inclined position
  m.joint<joints::RevoluteSpec>("pin", at_marker("ground"), at_marker("rod/s"));
  const VibrationReport report = vibrate(m, 3, RestPosition::static_equilibrium);
  EXPECT_EQ(report.rigid_modes, 0);
  ASSERT_EQ(report.vibrations.size(), 1U);
  // Differences of loads: 1e-10; the equilibrium is found to 1e-9 of the weight.
  EXPECT_NEAR(omegas(report)[0], std::sqrt(1.5 * kGravity / 0.8), 1e-8);
  // About the position as built there is no restoring force.
  const VibrationReport initial = vibrate(m, 3);
  EXPECT_EQ(initial.rigid_modes, 1);
  EXPECT_TRUE(initial.vibrations.empty());
}

TEST(SystemVibration, DoublePendulumHasItsTwoModes) {
  Mechanism m;
  m.planar();
  m.rigid_rod("upper", 1.0, 1.0, {0, 0, 0}, -M_PI / 2);
  m.rigid_rod("lower", 1.0, 1.0, {0, -1, 0}, -M_PI / 2);
  m.joint<joints::RevoluteSpec>("pin", at_marker("ground"), at_marker("upper/s"));
  m.joint<joints::RevoluteSpec>("elbow", at_marker("upper/e"), at_marker("lower/s"));
  const auto omega = omegas(vibrate(m, 5, RestPosition::static_equilibrium));
  ASSERT_EQ(omega.size(), 2U);
  // Equal uniform rods: [4/3 1/2; 1/2 1/3] q̈ + g/l [3/2 0; 0 1/2] q = 0.
  const double a = 7.0 / 36.0, b = -7.0 / 6.0, c = 0.75;
  const double root = std::sqrt(b * b - 4 * a * c);
  EXPECT_NEAR(omega[0] * omega[0], kGravity * (-b - root) / (2 * a), 1e-7);
  EXPECT_NEAR(omega[1] * omega[1], kGravity * (-b + root) / (2 * a), 1e-7);
}

TEST(SystemVibration, FreeBodyIsWhatNothingHolds) {
  Mechanism m({0, 0, 0});
  m.beam("beam", 1.0, 10);
  const auto built = m.build();
  const VibrationReport free = free_body_vibrations(*built, 0, {.count = 8});
  const VibrationReport system = system_vibrations(*built, {.count = 8});
  EXPECT_EQ(system.rigid_modes, 6);
  ASSERT_EQ(system.vibrations.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const double expected = free.vibrations[k].frequency;
    EXPECT_NEAR(system.vibrations[k].frequency, expected, 1e-8 * expected) << k;
    EXPECT_NEAR(system.vibrations[k].generalised_mass, free.vibrations[k].generalised_mass,
                1e-6 * system.mass);
    // Free modes have no effective mass.
    EXPECT_NEAR(system.vibrations[k].effective_mass[1], 0.0, 1e-12);
  }
}

TEST(SystemVibration, SpringsCountWithTheirStiffness) {
  // Three masses in a row between springs of k: ω² = (k/m)(2 − √2, 2, 2 + √2), ends held.
  Mechanism m({0, 0, 0});
  const double k = 300.0, mass = 1.5;
  for (int i = 0; i < 3; ++i) {
    const std::string name = "m" + std::to_string(i);
    m.rigid_rod(name, 0.1, mass, {1.0 * i, 0, 0});
    auto& guide = m.joint<joints::PrismaticSpec>("guide " + name, ground_at({1.0 * i, 0, 0}),
                                                 at_marker(name + "/s"));
    guide.axis = Eigen::Vector3d::UnitX();
  }
  const auto spring = [&](const std::string& name, const base::MarkerRef& a,
                          const base::MarkerRef& b) {
    auto& spec = m.load<loads::SpringDamperSpec>(name);
    spec.between = {a, b};
    spec.stiffness = k;
  };
  spring("a", ground_at({-1, 0, 0}), at_marker("m0/s"));
  spring("b", at_marker("m0/s"), at_marker("m1/s"));
  spring("c", at_marker("m1/s"), at_marker("m2/s"));
  spring("d", at_marker("m2/s"), ground_at({3, 0, 0}));
  const VibrationReport report = vibrate(m, 6);
  const auto omega = omegas(report);
  ASSERT_EQ(omega.size(), 3U);
  EXPECT_NEAR(omega[0] * omega[0], k / mass * (2 - std::sqrt(2.0)), 1e-9 * k);
  EXPECT_NEAR(omega[1] * omega[1], k / mass * 2, 1e-9 * k);
  EXPECT_NEAR(omega[2] * omega[2], k / mass * (2 + std::sqrt(2.0)), 1e-9 * k);
  EXPECT_NEAR(report.vibrations[0].energy_shares.back(), 1.0, 1e-12);
}

}  // namespace
}  // namespace buckens::analysis
