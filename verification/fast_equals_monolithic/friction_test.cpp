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

}  // namespace
}  // namespace buckens::verification::friction
