// SPDX-License-Identifier: Apache-2.0
// The tangent of bristles of a ball, against differences of its torque.
#include "buckens/loads/ball_bristles.h"

#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A ball that slides at 0.1 N m, after 1e-3 rad.
BallBristles bristles_of_ball(double share) {
  FrictionData data;
  data.static_coefficient = data.dynamic_coefficient = 0.2;
  data.radius = 0.01;
  data.viscous = 3e-3;
  return BallBristles(data, {100.0, 0.02, share});
}

/// A ball that has turned by a rotation in the step, and turns on.
struct Turning {
  Matrix3d first = spatial::exp_rotation(Vector3d(0.4, -0.3, 0.8)).toRotationMatrix();
  Vector3d z = {5e-4, -4e-4, 3e-4};  // before, in axes of the first marker
  Vector3d turned;                   // the same
  Vector3d rate;                     // world axes

  template <class F>
  auto see(F&& f) const {
    spatial::MarkerMotion one, other;
    one.R = first;
    other.R = first * spatial::exp_rotation(turned).toRotationMatrix();
    other.w = rate;
    const std::vector<double> states = {1, 0, 0, 0, z[0], z[1], z[2], 0.1};
    Sight sight{0.0, one, other};
    sight.reaction.force = {0, 30, 40};
    sight.states = states.data();
    return f(sight);
  }
  Vector3d torque(const BallBristles& law) const {
    return see([&](const Sight& sight) { return law.respond(sight).on_second.torque; });
  }
  /// The same turned on a little, in world axes.
  Turning after(const Vector3d& more) const {
    Turning out = *this;
    out.turned = spatial::log_rotation(spatial::exp_rotation(first.transpose() * more) *
                                       spatial::exp_rotation(turned));
    return out;
  }
};

void expect_tangent_of_differences(const BallBristles& law, const Turning& at, bool slides) {
  std::vector<SoftRow> rows;
  RowMix mix = RowMix::Identity(6, 6);
  at.see([&](const Sight& sight) {
    law.append_tangent(sight, rows);
    EXPECT_EQ(law.mix_rows(sight, mix), slides);
  });
  ASSERT_EQ(rows.size(), 6U);
  // The torque that the rows give by a rotation, and by its rate.
  const auto slope = [&](const Vector3d& turn, const Vector3d& rate) {
    Vector3d out = Vector3d::Zero();
    for (std::size_t j = 0; j < 6; ++j) {
      const Vector3d along = rows[j].J.segment<3>(6).transpose();
      const double force = -rows[j].stiffness * along.dot(turn) - rows[j].damping * along.dot(rate);
      for (std::size_t i = 0; i < 6; ++i) {
        const double share = mix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        out += share * force * rows[i].J.segment<3>(6).transpose();
      }
    }
    return out;
  };
  for (int k = 0; k < 3; ++k) {
    const Vector3d turn = 1e-8 * Vector3d::Unit(k), rate = 1e-7 * Vector3d::Unit(k);
    const Vector3d by_turn = 0.5 * (at.after(turn).torque(law) - at.after(-turn).torque(law));
    // Terms in the square of z are left out, and those in z where nothing slips.
    EXPECT_LT((slope(turn, Vector3d::Zero()) - by_turn).norm(), 2e-3 * 100.0 * 1e-8);
    Turning faster = at, slower = at;
    faster.rate += rate;
    slower.rate -= rate;
    const Vector3d by_rate = 0.5 * (faster.torque(law) - slower.torque(law));
    EXPECT_LT((slope(Vector3d::Zero(), rate) - by_rate).norm(), 2e-3 * 0.023 * 1e-7);
  }
}

TEST(BallBristles, TellTheirTangentWhereTheyBend) {
  for (const double share : {0.0, 0.5}) {
    const BallBristles law = bristles_of_ball(share);
    // Half a deflection, several, and so many that they surely slide; not at a whole number of the
    // parts over which they are integrated, where rounding would change how many these are.
    for (const double way : {5.5e-4, 4.3e-3, 0.1}) {
      Turning at;
      at.turned = way * Vector3d(0.8, 0.36, -0.48);
      at.rate = at.first * Vector3d(2.0, 1.5, -0.5);
      expect_tangent_of_differences(law, at, true);
    }
  }
}

TEST(BallBristles, AnswerAllAroundWhileNothingSlips) {
  Turning at;
  at.turned = Vector3d(-2e-4, 3e-4, 1e-4);
  at.rate = at.first * Vector3d(-0.02, 0.03, 0.01);
  expect_tangent_of_differences(bristles_of_ball(0.9), at, false);
}

TEST(BallBristles, DissipateWhatTheyDoNotStore) {
  const BallBristles law = bristles_of_ball(0.5);
  Turning at;
  at.turned = Vector3d(6e-4, 3e-4, -4e-4);
  at.rate = 3e3 * at.first * at.turned;  // the way goes straight on
  const Action now = at.see([&](const Sight& sight) { return law.respond(sight); });
  constexpr double kTime = 1e-8;
  const auto stored = [&](double t) {
    return at.after(t * at.rate).see([&](const Sight& sight) {
      return law.respond(sight).stored_energy;
    });
  };
  const double growth = (stored(kTime) - stored(-kTime)) / (2.0 * kTime);
  EXPECT_GT(now.dissipation, 0.0);
  EXPECT_NEAR(-now.on_second.torque.dot(at.rate), growth + now.dissipation, 2e-2 * now.dissipation);
}

}  // namespace
}  // namespace buckens::loads
