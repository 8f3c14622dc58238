// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/elastic_belt.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

ElasticBeltData data(double second_radius) {
  ElasticBeltData out;
  out.axis_F = out.x_F = Vector3d::Zero();
  out.axis_F.z() = out.x_F.x() = 1;
  out.x_M = out.x_F;
  out.first_radius = 0.06;
  out.second_radius = second_radius;
  out.stiffness = 8e4;
  out.damping = 30;
  out.pretension = 500;
  out.way = ElasticBelt::way(0.3, 0.06, second_radius);
  return out;
}

/// Two pulleys 0.3 m apart along x.
struct Drive {
  spatial::MarkerMotion a, b;
  std::array<double, 4> states{};

  explicit Drive(const ElasticBelt& belt) {
    b.p.x() = 0.3;
    Sight sight{0.0, a, b};
    belt.start_states(sight, states.data());
  }
  Sight sight() {
    Sight out{0.0, a, b};
    out.states = states.data();
    return out;
  }
  /// Moves everything by its velocities for a while.
  void move(double time) {
    for (spatial::MarkerMotion* m : {&a, &b}) {
      m->p += time * m->v;
      m->R = spatial::exp_rotation(time * m->w).toRotationMatrix() * m->R;
    }
  }
};

double power_of(const Action& action, const Drive& drive) {
  return action.on_first.force.dot(drive.a.v) + action.on_first.torque.dot(drive.a.w) +
         action.on_second.force.dot(drive.b.v) + action.on_second.torque.dot(drive.b.w);
}

/// By central differences along the motion. @param step [s]
double energy_rate(const ElasticBelt& belt, Drive drive, double step) {
  drive.move(step);
  const double after = belt.respond(drive.sight()).stored_energy;
  drive.move(-2 * step);
  return (after - belt.respond(drive.sight()).stored_energy) / (2 * step);
}

TEST(ElasticBelt, PowerIsTheRateOfItsEnergyUnlessItIsDampedOrSlips) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double second_radius : {0.09, -0.09, 0.03}) {
    ElasticBeltData with = data(second_radius);
    with.damping = 0;
    const ElasticBelt belt(with);
    Drive drive(belt);
    for (spatial::MarkerMotion* m : {&drive.a, &drive.b}) {
      m->v = Vector3d(any(random), any(random), 0);
      m->w = Vector3d(0, 0, 10 * any(random));
    }
    drive.move(2e-3);
    const Action action = belt.respond(drive.sight());
    EXPECT_NEAR(action.active_power, 0.0, 1e-9);  // all of it is stored
    const double power = power_of(action, drive);
    // Differences of second order and of the energy's rounding.
    EXPECT_NEAR(energy_rate(belt, drive, 1e-6), -power, 1e-5 * (1 + std::abs(power)));
  }
}

TEST(ElasticBelt, WhatItDissipatesIsWhatItTakesAndDoesNotStore) {
  // Slipping and held, damped and not, while the centres move, so that wraps and bound change. The
  // first time is too short for the strain to yield: damping alone makes it slip.
  for (const double second_radius : {0.09, -0.09, 0.03}) {
    for (const double damping : {0.0, 30.0}) {
      for (const double time : {1e-5, 1e-3}) {
        ElasticBeltData with = data(second_radius);
        with.damping = damping;
        with.coefficient = 0.25;
        const ElasticBelt belt(with);
        Drive drive(belt);
        drive.a.w.z() = -200;
        drive.b.v = Vector3d(2.0, 0.3, 0);
        drive.move(time);
        const Action action = belt.respond(drive.sight());
        const double power = power_of(action, drive);
        EXPECT_NEAR(energy_rate(belt, drive, 1e-7), -power - action.dissipation,
                    1e-5 * (1 + std::abs(power)))
            << second_radius << ' ' << damping << ' ' << time;
        if (damping > 0.0 || time > 1e-4) {
          EXPECT_GT(action.dissipation, 0.0);
        }
      }
    }
  }
}

TEST(ElasticBelt, TangentsAreDerivativesOfTheForces) {
  const ElasticBelt belt(data(0.09));
  Drive drive(belt);
  drive.a.w.z() = 4;
  drive.move(1e-3);
  std::vector<SoftRow> rows;
  belt.append_tangent(drive.sight(), rows);
  ASSERT_EQ(rows.size(), 2U);
  // Turning the first pulley changes the torque on the second by −k J₁J₂ per angle.
  const double expected = -(rows[0].stiffness * rows[0].J[2] * rows[0].J[8] +
                            rows[1].stiffness * rows[1].J[2] * rows[1].J[8]);
  const double before = belt.respond(drive.sight()).on_second.torque.z();
  drive.a.R = spatial::exp_rotation(Vector3d(0, 0, 1e-6)).toRotationMatrix() * drive.a.R;
  const double after = belt.respond(drive.sight()).on_second.torque.z();
  EXPECT_NEAR((after - before) / 1e-6, expected, 1e-5 * std::abs(expected));
}

TEST(ElasticBelt, SlipsWhereOneTensionIsTheOthersCapstanFactor) {
  ElasticBeltData slippery = data(0.06);
  slippery.coefficient = 0.25;
  const ElasticBelt belt(slippery);
  Drive drive(belt);
  drive.a.w.z() = -200;
  drive.move(1e-3);
  const BeltReading reading = belt.read(drive.sight());
  EXPECT_NEAR(reading.right / reading.left, std::exp(0.25 * M_PI), 1e-12);
  EXPECT_NEAR(reading.left + reading.right, 1000, 1e-9);
  // All but the strain of the bound has slipped.
  EXPECT_NEAR(reading.slip, -0.06 * 0.2 - (reading.left - reading.right) / 2 / 8e4, 1e-12);
}

TEST(ElasticBelt, PulleysThatCollideEndTheRun) {
  const ElasticBelt belt(data(-0.09));
  Drive drive(belt);
  drive.b.p.x() = 0.14;
  EXPECT_THROW(belt.respond(drive.sight()), NumericalError);
}

}  // namespace
}  // namespace buckens::loads
