// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/parameter_work.h"

#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/travel.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

using dynamics::BodyMotion;

ParameterWork::ParameterWork(const model::Model& model, const model::State& start) : model_(model) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    if (model.loads[k].element->has_driven_energy()) shares_.push_back({k, 0.0});
  }
  groups_.assign(shares_.size(), -1);
  for (std::size_t g = 0; g < model.contact_groups.size(); ++g) {
    if (model.contact_groups[g]->settings.stiffness == 0) continue;
    shares_.push_back({model.contact_groups[g]->load, 0.0});
    groups_.push_back(static_cast<int>(g));
  }
  stored_.resize(shares_.size());
  restart(start);
}

double ParameterWork::stored(std::size_t share, const model::State& at,
                             const std::vector<BodyMotion>& motions, double t,
                             const std::vector<double>& signals) const {
  const std::size_t load = shares_[share].load;
  dynamics::Circumstances around = dynamics::circumstances_of(at);
  around.signals = &signals;
  if (groups_[share] >= 0) {
    const auto group = static_cast<std::size_t>(groups_[share]);
    return dynamics::stored_in_group(model_, group, motions, t, around);
  }
  const dynamics::LoadEnds ends =
      dynamics::ends_of(model_, model_.loads[load], motions, &at.memory);
  return dynamics::action_of(model_, load, t, around, ends).stored_energy;
}

std::span<const ParameterWork::Share> ParameterWork::over_step(const model::State& before,
                                                               const model::State& state) {
  if (empty()) return {};
  const std::vector<BodyMotion> first = dynamics::motions_of(model_, before);
  const std::vector<BodyMotion> last = dynamics::motions_of(model_, state);
  if (!model_.signals.empty()) {
    // The states of blocks at the start of the step give them at its end, before any sample.
    dynamics::Circumstances around = dynamics::circumstances_of(before);
    around.lambda = &state.lambda;
    dynamics::evaluate_signals(model_, last, state.t, around, end_);
  }
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const double at_first = stored(n, before, first, state.t, end_.values) - stored_[n];
    const double unsampled = stored(n, state, last, state.t, end_.values);
    const double at_last = unsampled - stored(n, state, last, before.t, before.memory.signals);
    stored_[n] = stored(n, state, last, state.t, state.memory.signals);
    shares_[n].work = 0.5 * (at_first + at_last) + (stored_[n] - unsampled);
  }
  return shares_;
}

std::span<const ParameterWork::Share> ParameterWork::of_jump(const model::State& state) {
  if (empty()) return {};
  const std::vector<BodyMotion> motions = dynamics::motions_of(model_, state);
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const double now = stored(n, state, motions, state.t, state.memory.signals);
    shares_[n].work = now - stored_[n];
    stored_[n] = now;
  }
  return shares_;
}

void ParameterWork::visit_saved(const base::SaveVisit& visit) {
  for (std::size_t n = 0; n < stored_.size(); ++n) {
    visit.inside(n).number("stored", stored_[n]);
  }
}

}  // namespace buckens::analysis
