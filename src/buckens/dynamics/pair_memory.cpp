// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/pair_memory.h"

#include <algorithm>

#include "buckens/model/contact_group.h"

namespace buckens::dynamics {

namespace {

const model::PairLoads* find_pair(const std::vector<model::PairLoads>& all,
                                  const model::NearPair& pair) {
  const auto found = std::lower_bound(
      all.begin(), all.end(), pair,
      [](const model::PairLoads& one, const model::NearPair& wanted) { return one.pair < wanted; });
  return found == all.end() || found->pair != pair ? nullptr : &*found;
}

joints::CountedValue begin_coordinate(const model::Model& model, const model::Coordinate& own,
                                      const std::vector<BodyMotion>& motions) {
  return {0, own.law.fraction(evaluate_marker(model, own.first, motions).motion,
                              evaluate_marker(model, own.second, motions).motion, nullptr)};
}

}  // namespace

void follow_pairs(const model::Model& model, const std::vector<model::PairLoads>& before,
                  const std::vector<BodyMotion>& motions, model::State& state) {
  const model::RowMemory old = state.memory;
  model::RowMemory& memory = state.memory;
  memory.laws = linalg::Vector::Zero(model.num_law_states());
  const Eigen::Index own_states = before.empty() ? old.laws.size() : before.front().first_state;
  memory.laws.head(own_states) = old.laws.head(own_states);
  memory.coordinates.resize(model.coordinates.size());
  for (const model::PairLoads& pair : model.pair_loads) {
    const model::PairLoads* const known = find_pair(before, pair.pair);
    const auto first = static_cast<std::size_t>(pair.first_coordinate);
    if (known != nullptr) {
      memory.laws.segment(pair.first_state, pair.num_states) =
          old.laws.segment(known->first_state, known->num_states);
      std::copy_n(old.coordinates.begin() + known->first_coordinate, pair.count,
                  memory.coordinates.begin() + pair.first_coordinate);
      continue;
    }
    for (std::size_t k = first; k < first + pair.count; ++k) {
      memory.coordinates[k] = begin_coordinate(model, model.coordinates[k], motions);
    }
  }
  if (!memory.off.empty()) {
    memory.off.resize(model.loads.size());
    for (const model::PairLoads& pair : model.pair_loads) {
      const auto group = static_cast<std::size_t>(pair.pair.group);
      const char is_off = memory.off[model.contact_groups[group]->load];
      std::fill_n(memory.off.begin() + static_cast<std::ptrdiff_t>(pair.first), pair.count, is_off);
    }
  }
  if (!state.inputs.empty()) state.inputs.resize(model.loads.size());
}

void follow_pairs(const model::Model& model, const std::vector<model::PairLoads>& before,
                  std::vector<loads::RowStand>& at_rest) {
  if (at_rest.empty()) return;
  const std::vector<loads::RowStand> old = at_rest;
  at_rest.resize(before.empty() ? old.size() : before.front().first);
  at_rest.resize(model.loads.size());
  for (const model::PairLoads& pair : model.pair_loads) {
    const model::PairLoads* const known = find_pair(before, pair.pair);
    if (known == nullptr) continue;
    std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(known->first), pair.count,
                at_rest.begin() + static_cast<std::ptrdiff_t>(pair.first));
  }
}

}  // namespace buckens::dynamics
