// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/settings.h"

#include <algorithm>
#include <cmath>

namespace buckens::analysis {

namespace {
// With `step: auto` the longest step is this fraction of the duration.
constexpr long kStepsOfLongest = 100;
}  // namespace

stepping::Method method_of(model::IntegrationMethod method) {
  switch (method) {
    case model::IntegrationMethod::newmark:
      return stepping::Method::newmark;
    case model::IntegrationMethod::hht:
      return stepping::Method::hht;
    case model::IntegrationMethod::wilson:
      return stepping::Method::wilson;
    case model::IntegrationMethod::generalized_alpha:
      break;
  }
  return stepping::Method::generalized_alpha;
}

stepping::StepSettings step_settings(const model::SimulationSpec& spec) {
  stepping::StepSettings settings;
  settings.method = method_of(spec.method);
  settings.rho_inf = spec.rho_inf;
  settings.alpha = spec.alpha.value_or(settings.alpha);
  settings.theta = spec.theta.value_or(settings.theta);
  settings.position_projection = spec.projection;
  settings.newton_tolerance = spec.newton_tolerance;
  settings.outer_tolerance = spec.outer_tolerance;
  settings.iterate_coupling = spec.iterate_coupling;
  settings.kept_solves = spec.kept_solves;
  settings.max_newton = spec.max_iterations;
  settings.max_outer = spec.max_outer_iterations;
  return settings;
}

stepping::MarchSettings march_settings(const model::SimulationSpec& spec, double start) {
  stepping::MarchSettings march;
  march.duration = spec.duration;
  march.start = start;
  const double longest = spec.step.value_or(0.0);
  march.longest_steps = kStepsOfLongest;
  if (longest > 0.0) {
    const double steps = std::ceil((spec.duration - start) / longest - 1e-9);
    march.longest_steps = std::max(1L, std::lround(steps));
    march.given_step = longest;
  }
  if (spec.has_step_control()) {
    march.tolerance.emplace();
    march.tolerance->relative = spec.tolerance.value_or(march.tolerance->relative);
    march.tolerance->absolute = spec.absolute_tolerance;
  }
  return march;
}

}  // namespace buckens::analysis
