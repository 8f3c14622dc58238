// SPDX-License-Identifier: Apache-2.0
// Friction in the joints of flexible mechanisms: the slopes that the condensed step counts change
// how fast it converges, not where to; see README.md.
#include <string>

#include <gtest/gtest.h>

#include "verification/fast_equals_monolithic/mechanism_of_text.h"

namespace buckens::verification::friction {
namespace {

constexpr const char* kSliderCrank = R"(buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank: {rigid: {mass: 0.36, com: [0.075, 0, 0], inertia: [0, 0, 2.727e-3]}, markers: {shaft: {position: [0, 0, 0]}, pin: {position: [0.15, 0, 0]}}}
  rod: {beam: {to: [0.3, 0, 0], elements: 4, section: {circle: {diameter: 8 mm}}, material: steel}, at: {position: [0.15, 0, 0]}}
  slider: {rigid: {mass: 0.033, inertia: [0, 0, 1e-6]}, at: {position: [0.45, 0, 0]}}
joints:
  shaft: {revolute: {between: [ground, crank/shaft]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], angle: "150*t rad"}}
  big_end: {revolute: {between: [crank/pin, rod/start]}}
  small_end: {revolute: {between: [rod/end, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
loads:
  f_shaft: {hinge-friction: {joint: shaft, static: 0.1, radius: 10 mmSTICK}}
  f_big: {hinge-friction: {joint: big_end, static: 0.1, radius: 8 mmSTICK}}
  f_small: {hinge-friction: {joint: small_end, static: 0.1, radius: 8 mmSTICK}}
  f_guide: {slide-friction: {joint: guide, static: 0.1STICK}}
)";

std::string slider_crank(const std::string& stick) {
  std::string text = kSliderCrank;
  const std::string mark = "STICK";
  for (std::size_t at; (at = text.find(mark)) != std::string::npos;) {
    text.replace(at, mark.size(), stick);
  }
  return text;
}

TEST(FastEqualsMonolithic, SliderCrankWithFrictionInAllJoints) {
  for (const char* stick : {"", ", stick: rigid"}) {
    SCOPED_TRACE(stick);
    const MechanismOfText crank(slider_crank(stick));
    for (const stepping::Method method :
         {stepping::Method::generalized_alpha, stepping::Method::newmark}) {
      // A quarter of a turn: the slider moves by more than a tenth of the model's length.
      expect_same(crank.built->model, crank.start, tight(method, 1e-4), 100);
    }
  }
}

// Two balls that slide about axes that turn, and one that sticks. The rod is soft: rounding of
// positions bends a steel one by more than 1e-10 of its deflection, with and without friction. It
// is heavy: a light one turns about its own axis by what balls do to it in a step, and with
// rounding.
constexpr const char* kArms = R"(buckens: 1
gravity: [0, 0, -9.81]
materials: {soft: {E: 2 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  arm: {rigid: {mass: 1, inertia: [2e-3, 2e-3, 1e-4]}, at: {position: [0.1, 0, 0]}, markers: {o: {position: [-0.1, 0, 0]}, e: {position: [0.1, 0, 0]}}}
  rod: {beam: {to: [0.2, 0.1, 0.05], elements: 3, section: {circle: {diameter: 8 mm}}, material: soft}, at: {position: [0.2, 0, 0]}}
  bob: {rigid: {mass: 0.3, inertia: [1e-4, 2e-4, 2e-4]}, at: {position: [0.45, 0.1, 0.05]}, markers: {o: {position: [-0.05, 0, 0]}}}
joints:
  hang: {spherical: {between: [ground, arm/o]}}
  link: {spherical: {between: [arm/e, rod/start]}}
  held: {spherical: {between: [rod/end, bob/o]}}
loads:
  a: {ball-friction: {joint: hang, static: 0.2, radius: 10 mm, stick: rigid}}
  b: {ball-friction: {joint: link, static: 0.2, radius: 8 mm, viscous: 1e-3, stick: rigid}}
  c: {ball-friction: {joint: held, static: 0, preload: 20, stick: rigid}}
initial: {bodies: {arm: {velocity: [0, 0.8, -0.2], angular-velocity: [0, 2, 8]}, rod: {velocity: [0, 1.6, -0.4]}, bob: {velocity: [0, 1.6, -0.4]}}}
)";

TEST(FastEqualsMonolithic, ArmsOnBallsWithFrictionThatSticksRigidly) {
  const MechanismOfText arms(kArms);
  for (const stepping::Method method :
       {stepping::Method::generalized_alpha, stepping::Method::hht}) {
    expect_same(arms.built->model, arms.start, tight(method, 1e-4), 100);
  }
}

}  // namespace
}  // namespace buckens::verification::friction
