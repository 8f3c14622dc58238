// SPDX-License-Identifier: Apache-2.0
// Elastic teeth that rattle in their play between a flexible shaft and a wheel; see README.md.
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/fast_equals_monolithic/mechanism_of_text.h"

namespace buckens::verification {
namespace {

/// Numbers in no particular ratio.
std::string geared(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto any = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(engine);
  };
  return fmt::format(
      R"model(buckens: 1
gravity: [{}, -9.81, {}]
materials: {{plastic: {{E: 2 GPa, nu: 0.3, rho: 1400, damping: {{stiffness: 1e-4 s}}}}}}
bodies:
  shaft: {{beam: {{to: [0.5, 0, 0], elements: 2, section: {{circle: {{diameter: 30 mm}}}}, material: plastic}}}}
  wheel: {{rigid: {{mass: {}, com: [0, 0.02, 0], inertia: [2e-3, 3e-3, 4e-3]}}, at: {{position: [0, {}, 0.02]}}}}
joints:
  near: {{revolute: {{between: [ground, shaft/start], axis: [1, 0, 0]}}}}
  far: {{cylindrical: {{between: [{{ground: [0.5, 0, 0]}}, shaft/end], axis: [1, 0, 0]}}}}
  bearing: {{bushing: {{between: [{{ground: [0, {}, 0.02]}}, wheel], stiffness: [4e4, 3e4, 5e4], rotational-stiffness: [0, 400, 500], damping: [20, 30, 10]}}}}
loads:
  teeth: {{elastic-gear: {{between: [shaft/start, wheel], axis: [1, 0, 0], teeth: [{}, 31], helix-angle: {}, stiffness: 2e5, damping: {}, backlash: {}}}}}
  twist: {{torque: {{on: shaft/end, value: ["{}*sin(90*t)", 0, 0]}}}}
)model",
      any(-3, 3), any(-3, 3), any(0.5, 2), 0.12, 0.12, std::round(any(15, 40)), any(-0.3, 0.3),
      any(2, 20), any(5e-5, 2e-4), any(3, 6));
}

TEST(FastEqualsMonolithic, ElasticGears) {
  for (const std::uint32_t seed : {0U, 1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    const MechanismOfText gears(geared(seed));
    // Turns to and fro through its play: more than once in 200 steps of 0.5 ms.
    expect_same(gears.built->model, gears.start, tight(kMethods[seed], 5e-4));
  }
}

}  // namespace
}  // namespace buckens::verification
