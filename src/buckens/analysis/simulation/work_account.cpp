// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/work_account.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_friction.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

namespace {

/// Adds to powers at the start of a step, in `sums`, those at its end, for the mean of both.
void add_halves(const std::vector<dynamics::LoadPower>& end, double dynamics::LoadPower::*which,
                std::vector<dynamics::LoadPower>& sums) {
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k].*which = 0.5 * (sums[k].*which + end[k].*which);
  }
}

}  // namespace

WorkAccount::WorkAccount(const model::Model& model, const model::State& start, bool holds_at_states)
    : model_(model),
      joints_(model),
      parameters_(model, start),
      has_samples_(model.signals.have_samples()),
      laws_before_(start.memory.laws),
      t_(start.t),
      lambda_before_(start.lambda),
      lambda_start_(start.lambda),
      lambda_time_(start.lambda_time),
      parts_(model),
      start_(dynamics::energy(model, start)) {
  forces_.account(model);
  find_powers(start, before_);
  loads_before_ = forces_.of_loads;
  friction_.emplace(model, start, loads_before_);
  work_.parts = linalg::Vector::Zero(static_cast<Eigen::Index>(parts_.size()));
  parts_.set_stored(loads_before_, work_.parts);
  parts_start_ = work_.parts;
  work_before_ = work_;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    if (!body.is_flexible() || !body.flexible->is_damped()) continue;
    meshes_.emplace_back(model, b, start, holds_at_states);
  }
}

WorkAccount::Powers WorkAccount::powers_at(const model::State& state,
                                           const std::vector<dynamics::BodyMotion>& motions,
                                           const std::vector<double>* signals) {
  Powers out;
  dynamics::Circumstances around = dynamics::circumstances_of(state);
  around.signals = signals;
  dynamics::evaluate_forces(model_, motions, state.t, around, forces_);
  out.active = forces_.active_power + forces_.dissipation;
  out.damping = forces_.dissipation;
  return out;
}

void WorkAccount::find_powers(const model::State& state, Powers& out,
                              const std::vector<double>* signals) {
  dynamics::motions_of(model_, state, motions_);
  const Powers of_loads = powers_at(state, motions_, signals);
  out.active = of_loads.active;
  out.damping = of_loads.damping;
  joints_.evaluate(motions_, state.t, &state.memory, residuals_, &state.lambda, &forces_);
  out.g_t = residuals_.g_t;
}

void WorkAccount::take_inputs(const model::State& state) {
  find_powers(state, before_);
  loads_before_ = forces_.of_loads;
  parts_.set_stored(loads_before_, work_.parts);
  laws_before_ = state.memory.laws;
}

void WorkAccount::follow_pairs(const model::State& state) {
  parts_.follow_pairs(model_);
  forces_.account(model_);
  take_inputs(state);
}

double WorkAccount::landed(const model::State& state) {
  double sum = 0;
  const auto motions = dynamics::motions_of(model_, state);
  for (std::size_t k = 0; k < model_.loads.size(); ++k) {
    const model::Load& load = model_.loads[k];
    if (dynamic_cast<const loads::ContactFriction*>(load.element.get()) == nullptr) continue;
    if (laws_before_[load.first_state] != 0.0 || state.memory.is_off(k)) continue;
    const auto first = dynamics::evaluate_marker(model_, load.first, motions).motion;
    const auto second = dynamics::evaluate_marker(model_, load.second, motions).motion;
    const double power =
        dynamics::action_of(model_, k, state.t, dynamics::circumstances_of(state), first, second)
            .dissipation;
    means_[k].lost -= 0.5 * power;
    sum += power;
  }
  return sum;
}

void WorkAccount::add_shares(std::span<const ParameterWork::Share> shares) {
  for (const ParameterWork::Share& share : shares) {
    work_.external += share.work;
    part(parts_.of_load(share.load).supplied) += share.work;
    turnover_ += std::abs(share.work);
  }
}

void WorkAccount::take_event(const model::State& state, double gained, double lost) {
  take_inputs(state);
  friction_->restart(state, loads_before_);
  parameters_.restart(state);
  lambda_before_ = lambda_start_ = state.lambda;
  lambda_time_ = state.lambda_time;
  work_.external += gained;
  work_.dissipated += lost;
  part(parts_.of_events()) += gained;
  part(parts_.of_locks()) += lost;
  turnover_ += std::abs(gained) + lost;
}

void WorkAccount::restart(const model::State& state) {
  take_event(state, 0.0, 0.0);
  for (DampingWork& mesh : meshes_) mesh.start(state);
}

long WorkAccount::num_products() const {
  long sum = 0;
  for (const DampingWork& mesh : meshes_) sum += mesh.num_products();
  return sum;
}

const std::vector<double>* WorkAccount::unsampled(const model::State& before,
                                                  const model::State& state) {
  if (!has_samples_) return nullptr;
  dynamics::motions_of(model_, state, motions_);
  dynamics::Circumstances around = dynamics::circumstances_of(before);
  around.lambda = &state.lambda;
  dynamics::evaluate_signals(model_, motions_, state.t, around, unsampled_);
  return &unsampled_.values;
}

double WorkAccount::take_friction(const model::State& state, const stepping::StepReport* report,
                                  double h, const FrictionWork::Blows* blows) {
  if (report == nullptr || report->friction == nullptr) return 0.0;
  const std::span<const double> lost =
      friction_->add(*report->friction, h, state, forces_.of_loads, blows);
  double sum = 0;
  for (std::size_t n = 0; n < lost.size(); ++n) {
    double& mean = means_[friction_->loads()[n]].lost;
    sum += lost[n] / h - mean;
    mean = lost[n] / h;
  }
  return sum;
}

void WorkAccount::add(const model::State& state, const model::State* before,
                      const stepping::StepReport* report) {
  const std::vector<double>* signals = before != nullptr ? unsampled(*before, state) : nullptr;
  find_powers(state, now_, signals);
  Powers mean;
  mean.active = 0.5 * (before_.active + now_.active);
  mean.damping = 0.5 * (before_.damping + now_.damping);
  means_ = loads_before_;
  add_halves(forces_.of_loads, &dynamics::LoadPower::supplied, means_);
  add_halves(forces_.of_loads, &dynamics::LoadPower::lost, means_);
  add_halves(forces_.of_loads, &dynamics::LoadPower::rubbed, means_);
  mean.damping += take_friction(state, report, state.t - t_);
  add_step(state, mean, nullptr, RatesAtEnd::are_smooth);
  if (signals != nullptr) take_inputs(state);
}

void WorkAccount::add_impacts(const model::State& before, const model::State& state,
                              const stepping::StepReport& impacts) {
  const double h = state.t - t_;
  auto first = dynamics::motions_of(model_, before);
  auto last = dynamics::motions_of(model_, state);
  for (std::size_t b = 0; b < first.size(); ++b) {
    const spatial::Pose& from = first[b].frame.X_WB;
    const spatial::Pose& to = last[b].frame.X_WB;
    first[b].frame.v = last[b].frame.v = (to.p - from.p) / h;
    first[b].frame.w = last[b].frame.w = spatial::log_rotation(from.q.conjugate() * to.q) / h;
    first[b].y_dot = last[b].y_dot = (last[b].y - first[b].y) / h;
  }
  Powers mean;
  means_ = loads_before_;
  mean.active = powers_at(before, first).active;
  for (std::size_t k = 0; k < means_.size(); ++k) {
    means_[k].supplied = forces_.of_loads[k].supplied;
  }
  const std::vector<double>* signals = unsampled(before, state);
  mean.active = 0.5 * (mean.active + powers_at(state, last, signals).active);
  add_halves(forces_.of_loads, &dynamics::LoadPower::supplied, means_);
  // What closed rows hold must be seen at rest.
  find_powers(state, now_, signals);
  add_halves(forces_.of_loads, &dynamics::LoadPower::lost, means_);
  add_halves(forces_.of_loads, &dynamics::LoadPower::rubbed, means_);
  mean.damping = 0.5 * (before_.damping + now_.damping - landed(state));
  // Otherwise all that bodies have less of in their jumps is the loss.
  const FrictionWork::Blows blows{before, impacts.impact_rest};
  mean.damping +=
      take_friction(state, &impacts, h, impacts.before_blows.empty() ? &blows : nullptr);
  add_step(state, mean, &impacts, RatesAtEnd::have_jumped);
  if (signals != nullptr) take_inputs(state);
}

void WorkAccount::add_step(const model::State& state, const Powers& loads,
                           const stepping::StepReport* impacts, RatesAtEnd rates) {
  const double h = state.t - t_;
  // Joints receive −λ·g_t from their drives. A λ at mid-step is multiplied by the mean of g_t; one
  // at a later instant (Wilson) is interpolated to the end of the step.
  const bool is_mean = state.lambda_time < state.t - 0.25 * h;
  linalg::Vector& lambda = lambda_end_;
  lambda = state.lambda;
  if (state.lambda_time > state.t + 0.25 * h) {
    const double s = (state.t - lambda_time_) / (state.lambda_time - lambda_time_);
    lambda = (1.0 - s) * lambda_before_ + s * state.lambda;
  }
  const double drive = is_mean ? -0.5 * state.lambda.dot(before_.g_t + now_.g_t)
                               : -0.5 * (lambda_start_.dot(before_.g_t) + lambda.dot(now_.g_t));
  const double active = loads.active + drive;
  double dissipated = h * loads.damping + (impacts != nullptr ? impacts->impact_loss : 0.0);
  work_before_ = work_;
  for (DampingWork& mesh : meshes_) {
    const bool is_known = impacts != nullptr && !impacts->before_blows.empty() &&
                          impacts->before_blows[mesh.body()].d.size() > 0;
    const double lost = is_known ? mesh.add_before_blows(impacts->before_blows[mesh.body()], state)
                                 : mesh.add(state, forces_, rates);
    dissipated += lost;
    part(parts_.of_body(mesh.body())) += lost;
  }
  add_parts(h, is_mean ? state.lambda : lambda_start_, lambda, now_.g_t, impacts);
  work_.external += h * active;
  work_.dissipated += dissipated;
  turnover_ += h * std::abs(active) + dissipated;
  std::swap(before_, now_);
  std::swap(loads_before_, forces_.of_loads);
  if (model_.may_have_rigid_rows()) laws_before_ = state.memory.laws;
  lambda_before_ = state.lambda;
  lambda_start_ = lambda;
  lambda_time_ = state.lambda_time;
  t_ = state.t;
}

void WorkAccount::add_parts(double h, const linalg::Vector& first, const linalg::Vector& last,
                            const linalg::Vector& g_t, const stepping::StepReport* impacts) {
  for (std::size_t k = 0; k < means_.size(); ++k) {
    const results::EnergyParts::OfLoad& load = parts_.of_load(k);
    part(load.supplied) += h * means_[k].supplied;
    part(load.lost) += h * means_[k].lost;
    part(load.rubbed) += h * means_[k].rubbed;
  }
  if (impacts != nullptr) {
    for (const stepping::ImpactShare& share : impacts->impact_shares) {
      part(parts_.of_load(share.load).struck) += share.energy;
    }
  }
  for (const results::EnergyParts::OfDrive& drive : parts_.of_drives()) {
    for (int row = drive.first_row; row < drive.first_row + drive.num_rows; ++row) {
      part(drive.part) -= 0.5 * h * (first[row] * before_.g_t[row] + last[row] * g_t[row]);
    }
  }
  parts_.set_stored(forces_.of_loads, work_.parts);
}

results::EnergyAccount WorkAccount::account(const model::State& state) const {
  using Side = results::EnergyEntry::Side;
  results::EnergyAccount out;
  const auto add = [&](Side side, const std::string& kind, const std::string& of, double energy) {
    if (energy != 0.0) out.entries.push_back({side, kind, of, energy});
  };
  constexpr auto kNames = choice_names(model::EnergyKind::total);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const results::EnergyPart& own = parts_[k];
    const auto i = static_cast<Eigen::Index>(k);
    const Side side = results::is_work(own.kind)         ? Side::brought_in
                      : results::is_dissipated(own.kind) ? Side::lost
                                                         : Side::kept;
    const double before = side == Side::kept ? parts_start_[i] : 0.0;
    add(side, kNames[static_cast<std::size_t>(own.kind)], own.of, work_.parts[i] - before);
  }
  const dynamics::Energy now = dynamics::energy(model_, state);
  add(Side::kept, "kinetic", "", now.kinetic - start_.kinetic);
  add(Side::kept, "strain", "", now.strain - start_.strain);
  add(Side::kept, "gravity", "", now.gravity - start_.gravity);
  out.unexplained = now.total() - start_.total() - work_.external + work_.dissipated;
  return out;
}

}  // namespace buckens::analysis
