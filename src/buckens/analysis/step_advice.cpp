// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/step_advice.h"

#include <numbers>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {
// About twelve steps per period: phase error of a few percent per period.
constexpr double kResolved = 0.5;
}  // namespace

std::vector<std::string> judge_step(const model::Model& model, stepping::Stepper& stepper) {
  std::vector<std::string> advice;
  const double h = stepper.scheme().h;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double omega = stepper.lowest_excited_frequency(b);
    if (omega * h <= kResolved) continue;
    advice.push_back(fmt::format(
        "step {:.3g} s is too long for the elastic vibration of body \"{}\" (lowest about {:.4g} "
        "Hz, {:.1f} steps per period); it is damped rather than followed. To follow it use a step "
        "of {:.2g} s",
        h, model.bodies[b].name, omega / (2.0 * std::numbers::pi),
        2.0 * std::numbers::pi / (omega * h), 2.0 * std::numbers::pi / (20.0 * omega)));
  }
  return advice;
}

}  // namespace buckens::analysis
