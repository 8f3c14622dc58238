// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/run_statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/simulation/turn.h"

namespace buckens::analysis {

namespace {
// Energies below this share of weight times size are rounding of a mechanism that stands still.
constexpr double kNoEnergy = 1e-12;

std::string describe_undecided(long undecided, long steps) {
  return fmt::format(
      "in {} of {} steps no combination of sticking, sliding and letting go satisfied all places "
      "of rigid contacts and stops, and the last one was taken; look at the energy balance, and "
      "use a "
      "smaller step or a `stiffness` if it is open",
      undecided, steps);
}

std::string describe_jammed(long jammed, long impacts) {
  return fmt::format(
      "friction jammed in {} of {} impacts on rigid contacts and stops: no impulses both stop the "
      "slip and separate the bodies with their `restitution`, so they were stopped without a "
      "rebound, and the energy of the rebound was lost; give these contacts less `static`, no "
      "`restitution`, or a `stiffness` if they should rebound",
      jammed, impacts);
}
}  // namespace

RunStatistics::RunStatistics(const model::BuiltModel& built, TaskPool* pool)
    : built_(built),
      pool_(pool),
      joints_(built.model),
      energy_(built.model),
      touches_(built.model),
      lowest_frequency_(built.model.bodies.size(), 0.0),
      largest_spin_(built.model.bodies.size(), 0.0),
      deformation_(built.model.bodies.size()) {
  for (const body::Body& body : built.model.bodies) {
    limits_.push_back(body.is_flexible() ? std::make_unique<DeformationLimits>(body) : nullptr);
    energy_scale_ += kNoEnergy * body.mass * built.model.gravity.norm() * built.model.length;
  }
}

void RunStatistics::add_step(const stepping::StepReport& report, const model::State& state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    largest_spin_[b] = std::max(largest_spin_[b], state.bodies[b].frame.w.norm());
  }
  ++steps_;
  iterations_ += report.newton_iterations;
  most_iterations_ = std::max<long>(most_iterations_, report.newton_iterations);
  if (report.large_solve_rounds > 1) ++repeated_solves_;
  if (report.has_undecided_rows) ++undecided_steps_;
  impacts_ += report.impacts;
  if (report.has_near_impulses) ++steps_with_near_impulses_;
  jammed_impacts_ += report.jammed_impacts;
  impact_loss_ += report.impact_loss;
  joints_.add_step(report, state);
  residuals_.position = std::max(residuals_.position, report.position_residual);
  residuals_.velocity = std::max(residuals_.velocity, report.velocity_residual);
}

void RunStatistics::add_record(const model::State& state, double balance, double scale) {
  if (!std::isfinite(balance)) is_finite_ = false;
  largest_balance_ = std::max(largest_balance_, std::abs(balance));
  energy_scale_ = std::max(energy_scale_, scale);
  energy_.add_record(state);
  for (std::size_t b = 0; b < built_.model.bodies.size(); ++b) {
    const body::Body& body = built_.model.bodies[b];
    if (!body.is_flexible()) continue;
    const linalg::Vector& d = state.bodies[b].d;
    const auto rigid = body.flexible->sieve.rigid_part(d);
    const double size =
        std::max(rigid.head<3>().norm() / body.length_scale(), rigid.tail<3>().norm());
    residuals_.sieve = std::max(residuals_.sieve, size);
    deformation_[b].include(
        limits_[b]->measure(body.flexible->nodal(d), body.flexible->if_worth(pool_)));
  }
}

double RunStatistics::spin_ratio(std::size_t b) const {
  return lowest_frequency_[b] > 0.0 ? largest_spin_[b] / lowest_frequency_[b] : 0.0;
}

void RunStatistics::judge_spin(std::size_t b, results::RunSummary& summary) const {
  const double ratio = spin_ratio(b);
  if (lowest_frequency_[b] <= 0.0) return;
  summary.bodies.back().measures.emplace_back("spin_over_lowest_frequency", ratio);
  const body::FlexiblePart& part = *built_.model.bodies[b].flexible;
  if (ratio <= kFastSpin || part.geometric) return;
  auto& list = ratio > kDoubtedSpin ? summary.trust : summary.warnings;
  list.push_back(describe_spin(built_.model.bodies[b].name, ratio));
}

void RunStatistics::judge_shape(const model::WholeBody& whole, std::size_t most_bent,
                                const DeformationMeasure& found,
                                results::RunSummary& summary) const {
  const body::Body& part = built_.model.bodies[most_bent];
  if (!part.is_flexible()) return;
  DeformationVerdict verdict = judge_deformation(
      {whole.name, part.name, whole.count, part.flexible->geometric != nullptr}, found);
  for (std::string& text : verdict.warnings) summary.warnings.push_back(std::move(text));
  for (std::string& text : verdict.trust) summary.trust.push_back(std::move(text));
}

namespace {

void fill_step_control(const stepping::TimeMarch& march, results::StepControlEffort& out) {
  out.is_controlled = march.is_controlled();
  out.rejected = march.report().rejected;
  out.failed = march.report().failed;
  for (const stepping::RungUse& rung : march.rungs()) {
    out.sizes.push_back({rung.step, rung.steps, rung.factorisations});
    if (rung.steps == 0) continue;
    if (out.largest == 0.0) out.largest = rung.step;
    out.smallest = rung.step;
  }
}

void add_reduction(const body::Body& body, results::BodyEffort& effort) {
  if (!body.is_flexible() || !body.flexible->is_reduced()) return;
  const body::ReductionFigures& figures = body.flexible->reduction;
  effort.measures.emplace_back("kept_modes", figures.modes);
  effort.measures.emplace_back("static_shapes", figures.static_shapes);
  effort.measures.emplace_back("dof_of_mesh", figures.full_dofs);
  effort.measures.emplace_back("highest_mode_hz", figures.highest_mode / kTurn);
}

}  // namespace

void RunStatistics::add_whole(const model::WholeBody& whole, const stepping::StepLadder& ladder,
                              results::RunSummary& summary) const {
  results::BodyEffort effort;
  effort.name = whole.name;
  const auto first = static_cast<std::size_t>(whole.first);
  long iterations = 0;
  double solve_seconds = 0, solver_bytes = 0;
  std::size_t bent = first;  // the part with the largest rotation
  DeformationMeasure deformation;
  std::size_t fast = first;  // the part that spins fastest relative to its lowest frequency
  for (std::size_t b = first; b < first + static_cast<std::size_t>(whole.count); ++b) {
    const stepping::SolveCounts counts = ladder.counts(b);
    effort.dof += static_cast<int>(built_.model.bodies[b].num_dofs());
    effort.factorisations += counts.factorisations;
    effort.solves += counts.solves;
    effort.recycled += counts.recycled;
    iterations += counts.iterations;
    solve_seconds += counts.solve_seconds;
    solver_bytes += counts.solver_bytes;
    summary.setup_solves += counts.setup_solves;
    if (deformation_[b].rotation > deformation_[bent].rotation) bent = b;
    deformation.include(deformation_[b]);
    if (spin_ratio(b) > spin_ratio(fast)) fast = b;
  }
  if (solver_bytes > 0.0 || iterations > 0) {  // no bytes: another body's solver serves this one
    const auto solves = static_cast<double>(std::max(1L, effort.solves));
    effort.measures.emplace_back("iterations_per_solve", static_cast<double>(iterations) / solves);
    effort.measures.emplace_back("seconds_per_solve", solve_seconds / solves);
    effort.measures.emplace_back("solver_bytes", solver_bytes);
  }
  if (whole.is_divided()) effort.measures.emplace_back("frames", whole.count);
  add_reduction(built_.model.bodies[first], effort);
  if (built_.model.bodies[first].is_flexible()) {
    effort.measures.emplace_back("largest_rotation_rad", deformation.rotation);
    effort.measures.emplace_back("largest_strain", deformation.strain);
    effort.measures.emplace_back("largest_axial_load_over_buckling_load", deformation.axial_load());
  }
  summary.bodies.push_back(std::move(effort));
  judge_spin(fast, summary);
  judge_shape(whole, bent, deformation, summary);
}

namespace {

/// What imported meshes lack because the model file asks to leave parts out.
void doubt_meshes(const model::ModelDescription& description, results::RunSummary& summary) {
  for (const body::BodySpec& body : description.bodies) {
    const auto* mesh = std::get_if<fem::MeshSpec>(&body.kind);
    if (mesh == nullptr || !mesh->imported) continue;
    for (const fem::ImportNote& note : mesh->imported->notes) {
      if (!note.is_doubtful) continue;
      summary.trust.push_back(fmt::format("body \"{}\": {}", body.name, note.text));
    }
  }
}

}  // namespace

void RunStatistics::fill(const stepping::TimeMarch& march, results::RunSummary& summary) const {
  summary.steps = steps_;
  fill_step_control(march, summary.step_control);
  summary.newton_iterations.total = iterations_;
  summary.newton_iterations.max = most_iterations_;
  summary.newton_iterations.per_step_mean =
      steps_ > 0 ? static_cast<double>(iterations_) / static_cast<double>(steps_) : 0.0;
  summary.residuals = residuals_;
  summary.residuals.opening = joints_.opening();
  summary.residuals.opening_rate = joints_.opening_rate();
  const double energy_error = energy_scale_ > 0.0 ? largest_balance_ / energy_scale_ : 0.0;
  summary.energy_error = energy_error;
  summary.measures.emplace_back(
      "steps_with_repeated_solve",
      steps_ > 0 ? static_cast<double>(repeated_solves_) / static_cast<double>(steps_) : 0.0);
  if (impacts_ > 0) {
    summary.measures.emplace_back("impacts", static_cast<double>(impacts_));
    summary.measures.emplace_back("impact_loss", impact_loss_);
  }
  if (jammed_impacts_ > 0) {
    summary.measures.emplace_back("jammed_impacts", static_cast<double>(jammed_impacts_));
    summary.warnings.push_back(describe_jammed(jammed_impacts_, impacts_));
  }
  if (steps_with_near_impulses_ > 0) {
    summary.measures.emplace_back("steps_with_near_impulses",
                                  static_cast<double>(steps_with_near_impulses_));
  }
  if (undecided_steps_ > 0) {
    summary.measures.emplace_back("undecided_steps", static_cast<double>(undecided_steps_));
    summary.warnings.push_back(describe_undecided(undecided_steps_, steps_));
  }
  for (std::string& text : touches_.warnings(energy_scale_)) {
    summary.warnings.push_back(std::move(text));
  }
  doubt_meshes(built_.description, summary);
  for (const model::WholeBody& whole : built_.model.wholes)
    add_whole(whole, march.ladder(), summary);
  if (!is_finite_) {
    summary.trust.push_back(
        "an energy is too large to be a number; check units of masses, loads and velocities");
  }
  for (const std::string& text : {joints_.doubt(summary.end_time), energy_.doubt(energy_error)}) {
    if (!text.empty()) summary.trust.push_back(text);
  }
}

}  // namespace buckens::analysis
