// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/prepare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/displacement.h"
#include "buckens/analysis/initial/friction_start.h"
#include "buckens/analysis/initial/held_contacts.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/analysis/initial/rigid_rows_start.h"
#include "buckens/analysis/initial/start_rows.h"
#include "buckens/analysis/initial/stop_check.h"
#include "buckens/analysis/initial/velocity.h"
#include "buckens/analysis/initial/velocity_change.h"
#include "buckens/analysis/statics/equilibrium.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/pair_memory.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/elastic_belt.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::analysis {

namespace {

// A rate below this share of the model's length, or of 1 rad, per second is rounding.
constexpr double kStandsStill = 1e-12;
// So is a gap below this share of the model's length, or this angle.
constexpr double kTouches = 1e-9;

std::vector<std::string> describe_redundancy(const model::Model& model,
                                             const model::RowMemory& memory,
                                             const std::vector<int>& dependent) {
  std::vector<std::string> out;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (memory.is_released(j)) continue;
    const model::Joint& joint = model.joints[j];
    const int first = joint.first_row;
    const int count = static_cast<int>(joint.rows.size());
    const auto own = std::count_if(dependent.begin(), dependent.end(),
                                   [&](int row) { return row >= first && row < first + count; });
    if (own > 0) {
      out.push_back(fmt::format("joint \"{}\": {} of its {} equations follow from other joints",
                                joint.name, own, count));
    }
  }
  return out;
}

/// Settles which rigid rows hold. Rows that depend on the sign of their multiplier know it from
/// here on.
void settle_rows(const model::Model& model, const dynamics::MassMetric& metric,
                 const std::vector<int>& rows_in_use, model::State& state) {
  settle_rigid_rows(model, metric, rows_in_use, state);
  constexpr int kMostRounds = 4;  // signs of redundant rows may hang on each other
  for (int round = 0; round < kMostRounds; ++round) {
    const auto motions = dynamics::motions_of(model, state);
    if (!dynamics::follow_reactions(model, motions, state.t, state.lambda, state.memory)) return;
    settle_rigid_rows(model, metric, rows_in_use, state);
  }
}

/// Joints that hold nothing at the start; empty if there are none.
std::vector<char> released_at_start(const model::BuiltModel& built) {
  std::vector<char> out;
  const auto& joints = built.model.joints;
  for (const std::string& name : built.description.initial.released) {
    out.resize(joints.size(), 0);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].name == name && !joints[j].is_tie) out[j] = 1;
    }
  }
  return out;
}

/// Loads that do not act at the start; empty if there are none.
std::vector<char> off_at_start(const model::BuiltModel& built) {
  std::vector<char> out;
  const auto& loads = built.model.loads;
  for (const std::string& name : built.description.initial.off) {
    out.resize(loads.size(), 0);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (loads[k].name == name) out[k] = 1;
    }
  }
  return out;
}

/// What rows and laws remember as the motion begins.
model::RowMemory memory_at_start(const model::BuiltModel& built,
                                 const std::vector<dynamics::BodyMotion>& motions) {
  const model::Model& model = built.model;
  model::RowMemory out = dynamics::start_memory(model, motions, released_at_start(built));
  out.off = off_at_start(built);
  return out;
}

/// Whether a rigid row is at an end of its free way, in which regime; else 0.
/// @param size of the model along its coordinate: a length [m], or 1 rad
int touched_end(const model::Load& load, double value, double size) {
  const auto contact = static_cast<const loads::RigidLaw&>(*load.element).contact(value);
  return std::abs(contact.gap) <= kTouches * size ? contact.regime : 0;
}

/// Closes the rigid rows that press in the equilibrium from which the motion starts, and those that
/// touch, unless it starts with a speed there. What would pull lets go as the rows settle.
void close_rows(const model::Model& model, const RestStands& at_rest,
                const std::vector<dynamics::BodyMotion>& motions, model::RowMemory& memory) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (load.rigid_row < 0 || (!memory.off.empty() && memory.off[k])) continue;
    const auto coordinate = static_cast<std::size_t>(load.coordinate);
    const double size = model.coordinates[coordinate].law.is_angle() ? 1.0 : model.length;
    const auto motion = dynamics::coordinate_motion(model, coordinate, 0.0, &memory, motions);
    if (std::abs(motion.rate) > kStandsStill * size) continue;
    // A ball that turns about another axis slides.
    const bool is_of_ball = static_cast<const loads::RigidLaw&>(*load.element).row_of_ball() >= 0;
    if (is_of_ball && memory.laws[load.first_state] != 1.0) continue;
    const bool presses = !at_rest.empty() && at_rest[k].regime != 0;
    const int regime = presses ? at_rest[k].regime : touched_end(load, motion.value, size);
    if (regime == 0) continue;
    memory.laws[load.first_state] = regime;
    memory.laws[load.first_state + 1] = presses ? at_rest[k].force : 0.0;
  }
}

/// Lets belts keep what has wound on as bodies went to their equilibrium.
void keep_wound(const model::Model& model, const std::vector<dynamics::BodyMotion>& motions,
                model::State& state) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (dynamic_cast<const loads::ElasticBelt*>(load.element.get()) == nullptr) continue;
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, nullptr);
    const loads::Sight at_rest = dynamics::sight_of(model, k, state.t, {}, ends);
    load.element->find_states(at_rest, state.memory.laws.data() + load.first_state);
  }
}

/// Moves bodies to the equilibrium from which the motion starts. @return how its rows stand
/// @param held gets what friction of elastic contacts holds with
RestStands settle_at_rest(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                          model::RigidPairs* pairs, Prepared& out, std::vector<HeldContact>& held) {
  const StaticReport report = find_static_equilibrium(built.model, metric, out.state,
                                                      built.description.initial.friction, pairs);
  out.setup_factorisations = report.factorisations;
  out.warnings.insert(out.warnings.end(), report.warnings.begin(), report.warnings.end());
  out.notes.insert(out.notes.end(), report.notes.begin(), report.notes.end());
  held = report.held;
  return std::exchange(out.state.memory.at_rest, {});
}

/// Those of rigid contact groups that are near each other where the motion starts.
void find_pairs(const std::vector<dynamics::BodyMotion>& motions, model::RigidPairs& pairs,
                RestStands& at_rest) {
  const std::vector<model::PairLoads> before = pairs.model().pair_loads;
  pairs.set(dynamics::find_rigid_pairs(pairs.model(), motions, HUGE_VAL));
  dynamics::follow_pairs(pairs.model(), before, at_rest);
}

bool have_laws_of_reactions(const model::Model& model) {
  return std::any_of(model.loads.begin(), model.loads.end(),
                     [](const model::Load& load) { return load.joint >= 0; });
}

/// The speeds of drives by signals are known once positions are.
void begin_drives(const model::BuiltModel& built, model::State& state) {
  const auto motions = dynamics::motions_of(built.model, state);
  state.memory = memory_at_start(built, motions);
  count_start_turns(built.starts, built.model, state.memory);
  dynamics::start_signals(built.model, motions, state.t, state.memory);
}

/// Which rows of joints are independent where the motion starts.
void choose_rows(const model::Model& model, const dynamics::MassMetric& metric, Prepared& out) {
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, out.state), out.state.t,
                                 &out.state.memory, constraints);
  const linalg::RowRank rank = metric.split(constraints.rows);
  out.rows_in_use = rank.independent;
  out.redundant_rows = rank.dependent;
  out.redundant_text = describe_redundancy(model, out.state.memory, rank.dependent);
}

/// Whether coordinates of joints are to start with given values.
bool starts_elsewhere(const model::BuiltModel& built) {
  return std::any_of(built.starts.begin(), built.starts.end(),
                     [](const model::StartCoordinate& start) { return start.value.has_value(); });
}

}  // namespace

Prepared prepare(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                 model::RigidPairs* pairs) {
  const model::Model& model = built.model;
  const model::InitialSpec& initial = built.description.initial;
  Prepared out;
  out.notes = model.notes;
  out.state = model::placed_state(model);
  out.released = out.state.memory.released = released_at_start(built);
  out.state.memory.off = off_at_start(built);
  bool is_closed = false;
  try {
    assemble_positions(model, metric, out.state);
    out.moves = assembly_moves(model, out.state);
    is_closed = true;
  } catch (const ModelError&) {
    // Bodies that must be deformed to fit are closed by the static start.
    if (!initial.preload) throw;
    out.notes.push_back("bodies are deformed to close the joints (preload)");
  }
  if (is_closed && starts_elsewhere(built))
    assemble_positions(model, metric, out.state, built.starts);
  out.warnings = built.description.warnings;
  if (is_closed) {
    for (std::string& text : judge_assembly(built, out.moves)) {
      out.warnings.push_back(std::move(text));
    }
  }
  RestStands at_rest;
  std::vector<HeldContact> held;
  const bool is_static = initial.start == model::StartKind::static_equilibrium;
  bool is_at_rest = is_static || initial.preload;
  if (is_at_rest) at_rest = settle_at_rest(built, metric, pairs, out, held);
  if (set_initial_displacements(built, out.state)) {
    at_rest.clear();
    held.clear();
    is_at_rest = false;
    assemble_positions(model, metric, out.state, built.starts);
  }
  set_initial_velocities(built, out.state);
  if (!model.drives.empty()) begin_drives(built, out.state);

  choose_rows(model, metric, out);
  const model::State given = out.state;
  project_velocities(model, metric, out.state, built.starts);
  for (std::string& text : describe_velocity_changes(built, given, out.state)) {
    out.notes.push_back(std::move(text));
  }
  const auto motions = dynamics::motions_of(model, out.state);
  if (pairs != nullptr) find_pairs(motions, *pairs, at_rest);
  refuse_beyond_stops(model, out.state);
  out.state.memory = memory_at_start(built, motions);
  if (is_at_rest) keep_wound(model, motions, out.state);
  close_rows(model, at_rest, motions, out.state.memory);
  count_start_turns(built.starts, model, out.state.memory);
  dynamics::start_signals(model, motions, out.state.t, out.state.memory);  // they see the turns
  keep_held(model, held, motions, out.state);
  settle_rows(model, metric, out.rows_in_use, out.state);
  if (have_laws_of_reactions(model)) settle_friction(model, metric, out.rows_in_use, out.state);
  return out;
}

}  // namespace buckens::analysis
