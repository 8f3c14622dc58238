// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/friction_work.h"

#include <algorithm>

#include "buckens/spatial/counted_value.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

/// Whether a coordinate has a value: rates at which balls turn about an axis have none.
bool has_value(const model::Model& model, int coordinate) {
  return model.coordinates[static_cast<std::size_t>(coordinate)].joint >= 0;
}

}  // namespace

FrictionWork::FrictionWork(const model::Model& model, const model::State& start,
                           const std::vector<dynamics::LoadPower>& of_loads)
    : model_(model),
      loads_(dynamics::rubbing_joints(model)),
      past_(loads_.size()),
      lost_(loads_.size()) {
  restart(start, of_loads);
}

Vector3d FrictionWork::displacement(std::size_t n, const model::State& before,
                                    const model::State& end, double h) const {
  const int coordinate = model_.loads[loads_[n]].coordinate;
  if (coordinate >= 0 && has_value(model_, coordinate)) {
    const auto k = static_cast<std::size_t>(coordinate);
    return {spatial::difference(before.memory.coordinates[k], end.memory.coordinates[k]), 0.0, 0.0};
  }
  const auto motions = dynamics::motions_of(model_, end);
  const Vector3d after = dynamics::joint_rub_rate(model_, loads_[n], motions, end.t, &end.memory);
  return 0.5 * h * (past_[n].rate + after);
}

double FrictionWork::work_after(std::size_t n, const Vector3d& force, const model::State& end,
                                double rest) const {
  const bool has_meshes = std::any_of(model_.bodies.begin(), model_.bodies.end(),
                                      [](const body::Body& body) { return body.is_flexible(); });
  if (has_meshes) return 0.0;
  const auto motions = dynamics::motions_of(model_, end);
  const dynamics::JointRub rub =
      dynamics::joint_rub(model_, loads_[n], motions, end.t, dynamics::circumstances_of(end));
  const int coordinate = model_.loads[loads_[n]].coordinate;
  // The memory was formed right after the impacts.
  const Vector3d struck =
      coordinate < 0
          ? rub.rate
          : Vector3d(end.memory.coordinates[static_cast<std::size_t>(coordinate)].rate, 0.0, 0.0);
  return 0.5 * rest * (rub.force - force).dot(struck + rub.rate);
}

std::span<const double> FrictionWork::add(const stepping::FrictionOfStep& step, double h,
                                          const model::State& end,
                                          const std::vector<dynamics::LoadPower>& of_loads,
                                          const Blows* blows) {
  const stepping::Scheme& scheme = step.scheme();
  const double share = scheme.share_of_end();
  // As the method does, see stepping::rescale_algorithmic().
  const double ratio = h_ > 0.0 && scheme.has_algorithmic() ? scheme.h / h_ : 1.0;
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    Past& past = past_[n];
    const dynamics::JointRub& rub = step.rubs()[n];
    const Vector3d before = past.carried + ratio * (past.algorithmic - past.carried);
    const Vector3d carried = scheme.carried_acceleration<Vector3d>(past.carried, rub.force);
    const Vector3d after = scheme.algorithmic<Vector3d>(past.carried, before, carried);
    const Vector3d mean = (1.0 - share) * before + share * after;
    const Vector3d way = blows != nullptr ? displacement(n, blows->before, end, h)
                                          : Vector3d(0.5 * h * (past.rate + rub.rate));
    const double after_blows = blows != nullptr ? work_after(n, rub.force, end, blows->rest) : 0.0;
    const double stored = of_loads[loads_[n]].stored;
    lost_[n] = past.stored - stored - mean.dot(way) - after_blows;
    past = {rub.rate, carried, after, stored};
  }
  h_ = scheme.h;
  // Impacts and forces that fall within the step.
  if (end.history == 0) begin_at(end);
  return lost_;
}

void FrictionWork::begin_at(const model::State& state) {
  if (loads_.empty()) return;
  const auto motions = dynamics::motions_of(model_, state);
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const dynamics::JointRub rub =
        dynamics::joint_rub(model_, loads_[n], motions, state.t, dynamics::circumstances_of(state));
    past_[n].rate = rub.rate;
    past_[n].carried = past_[n].algorithmic = rub.force;
  }
  h_ = 0.0;
}

void FrictionWork::jump(const model::State& state, const std::vector<double>& signals) {
  if (loads_.empty()) return;
  const auto motions = dynamics::motions_of(model_, state);
  const dynamics::Circumstances after = dynamics::circumstances_of(state);
  dynamics::Circumstances before = after;
  before.signals = &signals;
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const auto force = [&](const dynamics::Circumstances& around) {
      return dynamics::joint_rub(model_, loads_[n], motions, state.t, around).force;
    };
    const Vector3d change = force(after) - force(before);
    past_[n].carried += change;
    past_[n].algorithmic += change;
  }
}

void FrictionWork::restart(const model::State& state,
                           const std::vector<dynamics::LoadPower>& of_loads) {
  begin_at(state);
  for (std::size_t n = 0; n < loads_.size(); ++n) past_[n].stored = of_loads[loads_[n]].stored;
}

void FrictionWork::visit_saved(const base::SaveVisit& visit) {
  visit.number("step", h_);
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const base::SaveVisit law = visit.inside(n);
    law.fixed("rate", past_[n].rate);
    law.fixed("carried", past_[n].carried);
    law.fixed("algorithmic", past_[n].algorithmic);
    law.number("stored", past_[n].stored);
  }
}

}  // namespace buckens::analysis
