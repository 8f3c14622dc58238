// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/later_end.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/analysis/simulation/settings.h"

namespace buckens::analysis {

namespace {

constexpr double kWholeCount = 1e-9;

}  // namespace

std::vector<std::string> changes_for_end(const model::ModelDescription& description,
                                         const StepGrid& steps, double until) {
  const double count = (until - steps.start) / steps.longest_step;
  const bool is_whole = std::abs(count - std::round(count)) <= kWholeCount * count;
  const double end = is_whole ? until : steps.start + std::ceil(count) * steps.longest_step;
  std::vector<std::string> out = {
      fmt::format("simulation.duration={:.17g}", end),
      fmt::format("output.every={:.17g}", plan_output(description).every)};
  const model::SimulationSpec& spec = *description.simulation;
  out.push_back(fmt::format("simulation.step={:.17g}", steps.longest_step));
  if (spec.has_step_control() && !spec.tolerance) {
    const double standard = march_settings(spec).tolerance->relative;
    out.push_back(fmt::format("simulation.tolerance={:.17g}", standard));
  }
  return out;
}

}  // namespace buckens::analysis
