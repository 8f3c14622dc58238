// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/saved_state.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "buckens/model/contact_group.h"

namespace buckens::model {

namespace {

constexpr long kMostBodies = 1L << 60;
constexpr int kMostTurns = 1 << 30;
constexpr int kMostMembers = 1 << 30;

void visit_coupling(const base::SaveVisit& visit, Eigen::Index n, Coupling& coupling) {
  visit.number("t", coupling.t);
  visit.fixed("J", coupling.moments.J);
  visit.fixed("J_dot", coupling.moments.J_dot);
  visit.fixed("l", coupling.moments.l);
  visit.fixed("l_dot", coupling.moments.l_dot);
  visit_nodal(visit, "load", n, true, coupling.load);
}

void visit_body(const base::SaveVisit& visit, const body::Body& body, int history, BodyState& s) {
  visit.fixed("p", s.frame.X_WB.p);
  visit.rotation("q", s.frame.X_WB.q);
  visit.fixed("w", s.frame.w);
  visit.fixed("v", s.frame.v);
  visit.fixed("w_dot", s.w_dot);
  visit.fixed("v_dot", s.v_dot);
  visit.fixed("w_alg", s.w_alg);
  visit.fixed("v_alg", s.v_alg);
  if (!body.is_flexible()) return;
  const Eigen::Index n = body.num_dofs();
  visit_nodal(visit, "d", n, false, s.d);
  visit_nodal(visit, "d_dot", n, false, s.d_dot);
  visit_nodal(visit, "d_ddot", n, false, s.d_ddot);
  visit_nodal(visit, "d_alg", n, false, s.d_alg);
  visit_saved(visit.inside("terms"), s.terms);
  visit_coupling(visit.inside("coupling"), n, s.coupling);
  visit_coupling(visit.inside("coupling_before"), n, s.coupling_before);
  visit_coupling(visit.inside("coupling_earlier"), n, s.coupling_earlier);
  // Steps extrapolate from what the history says is there.
  const Coupling* known[] = {&s.coupling, &s.coupling_before, &s.coupling_earlier};
  for (int k = 0; k < history && s.terms.have_load(); ++k) {
    if (known[k]->load.size() != n) visit.refuse("coupling", "loads of its history are missing");
  }
}

void visit_past(const base::SaveVisit& visit, const Model& model, PastStep& past) {
  visit.number("t", past.t);
  visit.vector_or_none("lambda", past.lambda, model.num_constraint_rows());
  visit.vector_or_none("accelerations", past.accelerations,
                       6 * static_cast<Eigen::Index>(model.bodies.size()));
}

void visit_inputs(const base::SaveVisit& visit, const Model& model, LoadInputs& inputs) {
  std::vector<int> given;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (inputs[k]) given.push_back(static_cast<int>(k));
  }
  visit.counts("given", given, 0, static_cast<int>(model.loads.size()) - 1);
  inputs.resize(given.empty() ? 0 : model.loads.size());
  for (const int k : given) {
    auto& input = inputs[static_cast<std::size_t>(k)];
    if (!model.loads[static_cast<std::size_t>(k)].element->takes_values()) {
      visit.refuse("given", "a load there takes no values");
    }
    if (!input) input.emplace();
    visit.fixed(std::to_string(k), *input);
  }
}

/// Which of `count` things are switched off.
void visit_switches(const base::SaveVisit& visit, const std::string& name, std::size_t count,
                    std::vector<char>& off) {
  std::vector<int> which;
  for (std::size_t k = 0; k < off.size(); ++k) {
    if (off[k] != 0) which.push_back(static_cast<int>(k));
  }
  visit.counts(name, which, 0, static_cast<int>(count) - 1);
  if (!visit.is_restoring()) return;
  off.assign(which.empty() ? 0 : count, 0);
  for (const int k : which) off[static_cast<std::size_t>(k)] = 1;
}

/// @throws InputError unless the pairs are in order and each can be one
void require_pairs(const base::SaveVisit& visit, const Model& model, bool are_rigid,
                   const std::vector<NearPair>& near) {
  const NearPair* before = nullptr;
  for (const NearPair& pair : near) {
    if (before != nullptr && !(*before < pair)) visit.refuse("near", "its pairs are not in order");
    before = &pair;
    const ContactGroup& group = *model.contact_groups[static_cast<std::size_t>(pair.group)];
    const auto first = static_cast<std::size_t>(pair.first);
    const auto second = static_cast<std::size_t>(pair.second);
    if (group.rigid.has_value() != are_rigid || std::max(first, second) >= group.members.size() ||
        !group.can_touch(first, second) || group.ordered(first, second).first != first) {
      visit.refuse("near", "two bodies in it cannot touch");
    }
  }
}

/// States of elastic pairs.
Eigen::Index count_states(const Model& model, const std::vector<NearPair>& near) {
  Eigen::Index needed = 0;
  for (const NearPair& pair : near) {
    needed +=
        model.contact_groups[static_cast<std::size_t>(pair.group)]
            ->contact(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second))
            .num_states();
  }
  return needed;
}

void visit_near(const base::SaveVisit& visit, const Model& model, RowMemory& memory) {
  if (model.contact_groups.empty()) return;
  visit_pairs(visit, model, false, memory.near);
  std::vector<double> states(memory.near_states.begin(), memory.near_states.end());
  visit.any_numbers("near_states", states);
  visit.number("near_time", memory.near_time);
  if (!visit.is_restoring()) return;
  memory.near_states =
      Eigen::Map<const linalg::Vector>(states.data(), static_cast<Eigen::Index>(states.size()));
  const Eigen::Index needed = count_states(model, memory.near);
  if (needed == memory.near_states.size()) return;
  visit.refuse("near_states",
               fmt::format("it has {} values, its pairs {}", memory.near_states.size(), needed));
}

void visit_memory(const base::SaveVisit& visit, const Model& model, RowMemory& memory) {
  memory.coordinates.resize(model.coordinates.size());
  for (std::size_t k = 0; k < memory.coordinates.size(); ++k) {
    const base::SaveVisit one = visit.inside("coordinates").inside(k);
    one.count("turns", memory.coordinates[k].turns, -kMostTurns, kMostTurns);
    one.number("fraction", memory.coordinates[k].fraction);
    one.number("rate", memory.coordinates[k].rate);
    one.number("t", memory.coordinates[k].t);
  }
  visit.vector("laws", memory.laws, model.num_law_states());
  visit.vector("rows", memory.rows, model.num_row_states());
  for (const double value : memory.rows) {
    // Whole turns are among them.
    if (!(std::abs(value) <= kMostTurns))
      visit.refuse("rows", fmt::format("{:g} is no state of a joint", value));
  }
  visit_switches(visit, "off", model.loads.size(), memory.off);
  visit_switches(visit, "released", model.joints.size(), memory.released);
  visit_near(visit, model, memory);
  if (model.signals.empty()) return;
  visit.list("signals", memory.signals, model.signals.all.size() + 1);
  visit.vector("blocks", memory.blocks, 3 * model.signals.num_states);
  visit.number("block_step", memory.block_step);
}

}  // namespace

void visit_nodal(const base::SaveVisit& visit, const std::string& name, Eigen::Index n,
                 bool may_be_empty, linalg::NodalVector& value) {
  // Saving changes nothing, but asks for a vector that could be changed.
  linalg::Vector numbers = visit.is_restoring() ? linalg::Vector() : value.copied();
  may_be_empty ? visit.vector_or_none(name, numbers, n) : visit.vector(name, numbers, n);
  if (visit.is_restoring()) value = std::move(numbers);
}

void visit_pairs(const base::SaveVisit& visit, const Model& model, bool are_rigid,
                 std::vector<NearPair>& near) {
  std::vector<int> numbers;
  for (const NearPair& pair : near) {
    numbers.insert(numbers.end(), {pair.group, pair.first, pair.second});
  }
  visit.counts("near", numbers, 0, kMostMembers);
  if (!visit.is_restoring()) return;
  if (numbers.size() % 3 != 0) visit.refuse("near", "it is not a list of pairs");
  near.clear();
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
    if (static_cast<std::size_t>(numbers[k]) >= model.contact_groups.size()) {
      visit.refuse("near", "there is no such group");
    }
    near.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
  require_pairs(visit, model, are_rigid, near);
}

void visit_saved(const base::SaveVisit& visit, body::CouplingTerms& terms) {
  visit.flag("quad_ref", terms.quad_ref);
  visit.flag("jvar", terms.jvar);
  visit.flag("cor_ref", terms.cor_ref);
  visit.flag("cent0", terms.cent0);
  visit.flag("cent1", terms.cent1);
  visit.flag("cor_fe", terms.cor_fe);
  visit.flag("eul_fe", terms.eul_fe);
  visit.flag("stiffening", terms.stiffening);
}

void visit_saved(const base::SaveVisit& visit, const Model& model, State& state) {
  long bodies = static_cast<long>(state.bodies.size());
  visit.count("num_bodies", bodies, 0, kMostBodies);
  if (static_cast<std::size_t>(bodies) != model.bodies.size()) {
    visit.refuse("num_bodies",
                 fmt::format("it is {}, the model has {}", bodies, model.bodies.size()));
  }
  state.bodies.resize(model.bodies.size());
  visit.number("t", state.t);
  visit.vector("lambda", state.lambda, model.num_constraint_rows());
  visit.number("lambda_time", state.lambda_time);
  visit.number("last_step", state.last_step);
  visit.flag("had_rounds", state.had_rounds);
  visit.count("history", state.history, 0, 3);
  visit_past(visit.inside("before"), model, state.before);
  visit_past(visit.inside("earlier"), model, state.earlier);
  visit_inputs(visit.inside("inputs"), model, state.inputs);
  visit_memory(visit.inside("memory"), model, state.memory);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    visit_body(visit.inside("bodies").inside(b), model.bodies[b], state.history, state.bodies[b]);
  }
}

}  // namespace buckens::model
