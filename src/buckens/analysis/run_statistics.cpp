// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/run_statistics.h"

#include <cmath>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {
// Beyond this rotation inside one frame linear elasticity errs by about 1 %.
constexpr double kLargeRotation = 0.1;
constexpr double kLargeEnergyError = 0.05;

double largest_rotation(const body::Body& body, const linalg::Vector& d) {
  double largest = 0;
  for (const auto& dofs : body.flexible->fe.dofs.node_dofs) {
    double square = 0;
    for (std::size_t k = 3; k < 6; ++k) {
      if (dofs[k] >= 0) square += d[dofs[k]] * d[dofs[k]];
    }
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

}  // namespace

RunStatistics::RunStatistics(const model::BuiltModel& built)
    : built_(built), largest_rotation_(built.model.bodies.size(), 0.0) {}

void RunStatistics::add_step(const stepping::StepReport& report) {
  ++steps_;
  iterations_ += report.newton_iterations;
  most_iterations_ = std::max<long>(most_iterations_, report.newton_iterations);
  if (report.large_solve_rounds > 1) ++repeated_solves_;
  residuals_.position = std::max(residuals_.position, report.position_residual);
  residuals_.velocity = std::max(residuals_.velocity, report.velocity_residual);
}

void RunStatistics::add_record(const model::State& state, double balance, double scale) {
  largest_balance_ = std::max(largest_balance_, std::abs(balance));
  energy_scale_ = std::max(energy_scale_, scale);
  for (std::size_t b = 0; b < built_.model.bodies.size(); ++b) {
    const body::Body& body = built_.model.bodies[b];
    if (!body.is_flexible()) continue;
    const linalg::Vector& d = state.bodies[b].d;
    const auto rigid = body.flexible->sieve.rigid_part(d);
    const double size =
        std::max(rigid.head<3>().norm() / body.length_scale(), rigid.tail<3>().norm());
    residuals_.sieve = std::max(residuals_.sieve, size);
    largest_rotation_[b] = std::max(largest_rotation_[b], largest_rotation(body, d));
  }
}

void RunStatistics::fill(const stepping::Stepper& stepper, results::RunSummary& summary) const {
  summary.steps = steps_;
  summary.newton_iterations.total = iterations_;
  summary.newton_iterations.max = most_iterations_;
  summary.newton_iterations.per_step_mean =
      steps_ > 0 ? static_cast<double>(iterations_) / static_cast<double>(steps_) : 0.0;
  summary.residuals = residuals_;
  const double energy_error = energy_scale_ > 0.0 ? largest_balance_ / energy_scale_ : 0.0;
  summary.energy_error = energy_error;
  summary.measures.emplace_back(
      "steps_with_repeated_solve",
      steps_ > 0 ? static_cast<double>(repeated_solves_) / static_cast<double>(steps_) : 0.0);
  for (std::size_t b = 0; b < built_.model.bodies.size(); ++b) {
    const body::Body& body = built_.model.bodies[b];
    const stepping::SolveCounts counts = stepper.counts(b);
    results::BodyEffort effort;
    effort.name = body.name;
    effort.dof = static_cast<int>(body.num_dofs());
    effort.factorisations = counts.factorisations;
    effort.solves = counts.solves;
    if (body.is_flexible()) {
      effort.measures.emplace_back("largest_rotation_rad", largest_rotation_[b]);
    }
    summary.setup_solves += counts.setup_solves;
    summary.bodies.push_back(std::move(effort));
    if (largest_rotation_[b] > kLargeRotation) {
      summary.trust.push_back(fmt::format(
          "body \"{}\" bends by up to {:.2g} rad within its frame, more than the {:.1f} rad that "
          "linear elasticity bears; divide it into several bodies",
          body.name, largest_rotation_[b], kLargeRotation));
    }
  }
  if (energy_error > kLargeEnergyError) {
    summary.trust.push_back(fmt::format(
        "the energy balance is open by {:.2g} of the energy involved; use a smaller step",
        energy_error));
  }
}

}  // namespace buckens::analysis
