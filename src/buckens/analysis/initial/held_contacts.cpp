// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/held_contacts.h"

#include "buckens/dynamics/row_memory.h"
#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

namespace {

void keep_held_pair(const model::Model& model, const HeldContact& held,
                    const std::vector<dynamics::BodyMotion>& motions, model::State& state) {
  double* states = state.memory.near_states.data();
  for (const model::NearPair& near : state.memory.near) {
    const model::ContactGroup& group = *model.contact_groups[static_cast<std::size_t>(near.group)];
    const auto i = static_cast<std::size_t>(near.first), j = static_cast<std::size_t>(near.second);
    const loads::Contact contact = group.contact(i, j);
    if (near == *held.pair) {
      const auto at = [&](std::size_t member) {
        return dynamics::evaluate_marker(model, group.members[member].marker, motions).motion;
      };
      const spatial::MarkerMotion first = at(i), second = at(j);
      loads::Sight sight{state.t, first, second};
      sight.signals = state.memory.signals;
      contact.hold(sight, held.along, states);
      return;
    }
    states += contact.num_states();
  }
}

}  // namespace

void keep_held(const model::Model& model, const std::vector<HeldContact>& held,
               const std::vector<dynamics::BodyMotion>& motions, model::State& state) {
  dynamics::SignalValues signals;
  const dynamics::Circumstances around = dynamics::with_signals(
      model, motions, state.t, {nullptr, &state.memory, nullptr, nullptr}, signals);
  for (const HeldContact& one : held) {
    if (one.pair) {
      keep_held_pair(model, one, motions, state);
      continue;
    }
    const model::Load& load = model.loads[one.load];
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, &state.memory);
    const auto& contact = static_cast<const loads::Contact&>(*load.element);
    contact.hold(dynamics::sight_of(model, one.load, state.t, around, ends), one.along,
                 state.memory.laws.data() + load.first_state);
  }
}

}  // namespace buckens::analysis
