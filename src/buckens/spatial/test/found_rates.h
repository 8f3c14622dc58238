// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/spatial/rigid_touch.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::test {

/// Compares what a finder says of the motion with differences of fourth order.
/// @return 0 where the place jumps nearby, so that differences mean nothing; else 1
inline int expect_rates(const spatial::TouchFinder& finder, const MarkerPath& F,
                        const MarkerPath& M) {
  const auto look = [&](double t) {
    spatial::TouchPlace out;
    finder.look(F.at(t), M.at(t), out);
    return out;
  };
  // A feature that ends, or gives way to another one, is seen where it goes over.
  constexpr double kStep = 2e-4;
  const spatial::TouchPlace now = look(0);
  for (const double t : {-2 * kStep, -kStep, kStep, 2 * kStep}) {
    const spatial::TouchPlace then = look(t);
    const double jump = (then.place - now.place - t * now.place_rate).norm();
    const double turn = (then.normal_rate - now.normal_rate).norm();
    const double bend = (then.place_rate - now.place_rate).norm();
    if (jump > 0.02 * std::abs(t) || turn > 0.2 || bend > 0.2) return 0;
  }
  const spatial::MarkerMotion first = F.at(0), second = M.at(0);
  const auto gap = [&](double t) { return look(t).gap; };
  EXPECT_NEAR(now.normal.norm(), 1, 1e-13);
  EXPECT_NEAR(now.normal.dot(now.velocity(first, second)), derivative(gap, kStep), 1e-9);
  for (int k = 0; k < 3; ++k) {
    const auto place = [&](double t) { return look(t).place[k]; };
    const auto normal = [&](double t) { return look(t).normal[k]; };
    // Of the order of 1e3 times the fourth power of the step, and rounding over it.
    EXPECT_NEAR(now.place_rate[k], derivative(place, kStep), 1e-6);
    EXPECT_NEAR(now.normal_rate[k], derivative(normal, kStep), 1e-6);
  }
  return 1;
}

}  // namespace buckens::test
