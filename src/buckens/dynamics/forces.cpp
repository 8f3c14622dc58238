// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/forces.h"

#include <algorithm>

#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/joint_set.h"
#include "buckens/dynamics/travel.h"

namespace buckens::dynamics {

bool has_regimes(const model::Load& load) {
  return load.coordinate >= 0 || load.element->num_states() > 0;
}

void add_wrench(const model::Model& model, const model::MarkerId& id,
                const body::MarkerKinematics& kinematics, const spatial::Wrench& wrench,
                Forces& out) {
  if (id.body == model::kGround) return;
  const auto b = static_cast<std::size_t>(id.body);
  out.frame[b] += kinematics.frame_load(wrench);
  const body::Marker& marker = model.bodies[b].markers[static_cast<std::size_t>(id.marker)];
  if (!marker.follows_mesh()) return;
  const Eigen::Matrix<double, 6, 1> load = kinematics.interface_load(wrench);
  out.interface[b].segment<3>(marker.translation_row) += load.head<3>();
  if (marker.rotation_row >= 0) out.interface[b].segment<3>(marker.rotation_row) += load.tail<3>();
}

namespace {

void add_row(const BodyRow& row, double multiplier, Forces& out) {
  if (row.body == model::kGround) return;
  const auto b = static_cast<std::size_t>(row.body);
  out.frame[b] += multiplier * row.frame.transpose();
  if (row.translation_row >= 0) {
    out.interface[b].segment<3>(row.translation_row) +=
        multiplier * row.interface.head<3>().transpose();
  }
  if (row.rotation_row >= 0) {
    out.interface[b].segment<3>(row.rotation_row) +=
        multiplier * row.interface.tail<3>().transpose();
  }
}

// Of differences for tangents: far above rounding, and formulas are smooth over less.
constexpr double kShift = 1e-6;

/// A law on a joint coordinate whose tangent is wanted, its row being the last one of `rows`.
struct SlopesOf {
  const model::Model& model;
  const loads::Sight& sight;
  SoftRows& rows;
};

/// Adds how its force answers its own coordinate through signals: the gains of a controller belong
/// to the tangent. What it does through other coordinates the iteration finds.
void add_slopes_of_signals(const model::Load& load, const std::vector<BodyMotion>& motions,
                           const Circumstances& around, const SlopesOf& of) {
  const double before = load.element->respond(of.sight).along_coordinate;
  const auto slope = [&](const CoordinateShift& shift) {
    Circumstances plain = around;
    plain.signals = nullptr;
    evaluate_signals(of.model, motions, of.sight.t, plain, of.rows.shifted, shift);
    loads::Sight shifted = of.sight;
    shifted.signals = of.rows.shifted.values;
    return (before - load.element->respond(shifted).along_coordinate) / kShift;
  };
  loads::SoftRow& row = of.rows.of_one.back();
  row.stiffness = std::max(0.0, row.stiffness + slope({load.coordinate, kShift, 0.0}));
  row.damping = std::max(0.0, row.damping + slope({load.coordinate, 0.0, kShift}));
}

/// The share of a load along one row. @return its power [W]
double add_pattern(const model::Load& load, const std::vector<BodyMotion>& motions,
                   const loads::Action& action, Forces& out) {
  const auto b = static_cast<std::size_t>(load.first.body);
  const double power = action.along_pattern * motions[b].y_dot[load.pattern_row];
  out.interface[b][load.pattern_row] += action.along_pattern;
  out.active_power += power;
  return power;
}

/// What a cable does to its third marker and those behind it.
void add_others(const model::Model& model, std::size_t k, double t, const Circumstances& around,
                const LoadEnds& ends, Forces& out) {
  const model::Load& load = model.loads[k];
  out.on_others.assign(load.others.size(), {});
  add_to_others(model, k, t, around, ends, out.on_others);
  for (std::size_t m = 0; m < load.others.size(); ++m) {
    add_wrench(model, load.others[m], ends.others[m], out.on_others[m], out);
  }
}

}  // namespace

void Forces::reset(const model::Model& model, const Eigen::Vector3d& gravity) {
  frame.resize(model.bodies.size());
  interface.resize(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    frame[b].setZero();
    frame[b].tail<3>() = model.bodies[b].mass * gravity;
    interface[b].setZero(model.bodies[b].num_interface_rows());
  }
  stored_energy = 0;
  active_power = 0;
  dissipation = 0;
  regimes.clear();
  rigid.clear();
  std::fill(of_loads.begin(), of_loads.end(), LoadPower());
}

void Forces::leave_place(const model::Load& load) {
  if (has_regimes(load)) regimes.push_back(0);
  if (load.rigid_row >= 0) rigid.emplace_back();
}

void evaluate_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     Forces& out, double load_factor) {
  evaluate_forces(model, motions, t, Circumstances(), out, load_factor);
}

void evaluate_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     const Circumstances& given, Forces& out, double load_factor,
                     const std::vector<char>* at_joints) {
  const Circumstances around = with_signals(model, motions, t, given, out.signals);
  out.reset(model, gravity_at(model, signals_of(around)));
  EndsInTurn in_turn(model, motions, around.memory);
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (at_joints != nullptr && (*at_joints)[k] != 0) {
      out.leave_place(load);
      continue;
    }
    if (is_open_place(model, k, around)) {
      out.leave_place(load);
      continue;
    }
    const LoadEnds& ends = in_turn.of(load);
    loads::Action action = citing(load, [&] { return action_of(model, k, t, around, ends); });
    if (load_factor != 1.0 && load.element->is_applied()) {
      for (spatial::Wrench* wrench : {&action.on_first, &action.on_second}) {
        wrench->torque *= load_factor;
        wrench->force *= load_factor;
      }
      action.active_power *= load_factor;
      action.along_pattern *= load_factor;
    }
    if (ends.travel) {
      ends.travel->add_force(action.on_second.force, out);
    } else {
      add_wrench(model, load.first, ends.first, action.on_first, out);
      add_wrench(model, load.second, ends.second, action.on_second, out);
      if (!load.others.empty()) add_others(model, k, t, around, ends, out);
    }
    const double along_pattern =
        load.pattern_row >= 0 ? add_pattern(load, motions, action, out) : 0.0;
    out.stored_energy += action.stored_energy;
    out.active_power += action.active_power;
    out.dissipation += action.dissipation;
    if (!out.of_loads.empty()) {
      out.of_loads[k].add(action);
      out.of_loads[k].supplied += along_pattern;
    }
    if (has_regimes(load)) out.regimes.push_back(action.regime);
    if (load.rigid_row >= 0) out.rigid.push_back(action.row);
  }
  add_group_forces(model, motions, t, around, out);
}

void add_joint_forces(const Constraints& constraints, const linalg::Vector& lambda, Forces& out) {
  for (std::size_t k = 0; k < constraints.rows.size(); ++k) {
    const double multiplier = lambda[static_cast<Eigen::Index>(k)];
    if (multiplier == 0.0) continue;
    for (const BodyRow* part : constraints.rows[k].parts()) add_row(*part, multiplier, out);
  }
}

namespace {

/// Room for shares of markers behind the second, of rows that are no more.
std::vector<std::vector<BodyRow>>& left_shares() {
  thread_local std::vector<std::vector<BodyRow>> room;
  return room;
}

/// Gives a row with shares behind the second the room of one that is no more.
void take_shares(SystemRow& row) {
  if (row.more.capacity() > 0 || left_shares().empty()) return;
  row.more = std::move(left_shares().back());
  left_shares().pop_back();
}

SystemRow tangent_row(const model::Model& model, const model::Load& load, const LoadEnds& ends,
                      const spatial::PairRow& J) {
  SystemRow out;
  if (ends.travel) take_shares(out);
  row_of(model, load, ends, J, out);
  return out;
}

/// Forgets all rows, but not the room that they took, so that steps allocate nothing.
void clear_rows(std::vector<SystemRow>& rows) {
  for (SystemRow& row : rows) {
    if (row.more.capacity() == 0) continue;
    row.more.clear();
    left_shares().push_back(std::move(row.more));
  }
  rows.clear();
}

/// Shares of the markers behind the second.
void add_parts(const model::Model& model, const model::Load& load, const LoadEnds& ends,
               const loads::TwistRow* of_others, SystemRow& out) {
  static const model::MarkerId kNowhere;
  static const body::MarkerKinematics kAtRest;
  if (!load.others.empty()) take_shares(out);
  for (std::size_t m = 0; m < load.others.size(); ++m) {
    spatial::PairRow J = spatial::PairRow::Zero();
    J.head<6>() = of_others[m];
    out.more.push_back(
        system_row(model, load.others[m], ends.others[m], kNowhere, kAtRest, J).first);
  }
}

}  // namespace

namespace {

/// Appends the rows of one load, as its element has given them.
void append_rows_of(const model::Model& model, const model::Load& load, const LoadEnds& ends,
                    const loads::Sight& sight, SoftRows& out) {
  out.of_others.clear();
  if (!load.others.empty()) load.element->append_others_of_rows(sight, out.of_others);
  const loads::TwistRow* of_others = out.of_others.data();
  for (const loads::SoftRow& row : out.of_one) {
    out.rows.push_back(tangent_row(model, load, ends, row.J));
    add_parts(model, load, ends, of_others, out.rows.back());
    of_others += load.others.size();
    out.stiffness.push_back(row.stiffness);
    out.damping.push_back(row.damping);
    out.rigid.push_back(load.rigid_row);
    out.is_closed.push_back(row.is_rigid ? 1 : 0);
  }
}

/// A row that does nothing, between the bodies of a load.
void append_open_place(const model::Model& model, const model::Load& load, SoftRows& out) {
  const auto nothing = [&](const model::MarkerId& id) {
    BodyRow row;
    row.body = id.body;
    if (id.body == model::kGround) return row;
    const auto& markers = model.bodies[static_cast<std::size_t>(id.body)].markers;
    row.translation_row = markers[static_cast<std::size_t>(id.marker)].translation_row;
    row.rotation_row = markers[static_cast<std::size_t>(id.marker)].rotation_row;
    return row;
  };
  out.rows.push_back({nothing(load.first), nothing(load.second), {}});
  out.stiffness.push_back(0.0);
  out.damping.push_back(0.0);
  out.rigid.push_back(load.rigid_row);
  out.is_closed.push_back(0);
  out.regimes.push_back(0);
}

}  // namespace

void append_mix(const loads::ForceElement& element, const loads::Sight& sight, SoftRows& out) {
  loads::RowMix mix;
  if (!element.mix_rows(sight, mix)) return;
  out.mixes.push_back(mix);
  // Of the last ones: those of a ball that sticks rigidly belong to three loads.
  const auto end = static_cast<int>(out.rows.size()) + element.num_soft_rows();
  out.first_of_mix.push_back(end - static_cast<int>(mix.rows()));
}

void SoftRows::clear() {
  regimes.clear();
  clear_rows(rows);
  stiffness.clear();
  damping.clear();
  rigid.clear();
  is_closed.clear();
  mixes.clear();
  first_of_mix.clear();
}

void append_rows(const SoftRows& from, SoftRows& to) {
  const int first = static_cast<int>(to.rows.size());
  for (const int mixed : from.first_of_mix) to.first_of_mix.push_back(first + mixed);
  for (const loads::RowMix& mix : from.mixes) to.mixes.push_back(mix);
  // One by one: nearly all laws have a single row.
  for (std::size_t k = 0; k < from.rows.size(); ++k) {
    to.rows.push_back(from.rows[k]);
    to.stiffness.push_back(from.stiffness[k]);
    to.damping.push_back(from.damping[k]);
    to.rigid.push_back(from.rigid[k]);
    to.is_closed.push_back(from.is_closed[k]);
  }
  for (const int regime : from.regimes) to.regimes.push_back(regime);
}

void give_nothing(std::vector<loads::SoftRow>& rows) {
  for (loads::SoftRow& row : rows) {
    row.stiffness = row.damping = 0.0;
    row.is_rigid = false;
  }
}

void evaluate_soft_rows(const model::Model& model, const std::vector<BodyMotion>& motions,
                        SoftRows& out) {
  evaluate_soft_rows(model, motions, 0.0, Circumstances(), out);
}

void evaluate_soft_rows(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                        const Circumstances& given, SoftRows& out, const ReactionSlopes* followers,
                        std::vector<ReactionSlope>* slopes, const JointSet* at_joints,
                        const std::vector<SoftRows>* of_laws) {
  const Circumstances around = with_signals(model, motions, t, given, out.signals);
  out.clear();
  if (slopes != nullptr) slopes->clear();
  std::vector<loads::SoftRow>& rows = out.of_one;
  EndsInTurn in_turn(model, motions, around.memory);
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (load.element->num_soft_rows() == 0) continue;
    if (at_joints != nullptr && at_joints->laws()[k] != 0) {
      if (of_laws != nullptr) {
        append_rows((*of_laws)[at_joints->number_of(k)], out);
      } else {
        at_joints->append_soft_rows(k, motions, t, around, out, slopes);
      }
      continue;
    }
    if (is_open_place(model, k, around)) {
      append_open_place(model, load, out);
      continue;
    }
    const LoadEnds& ends = in_turn.of(load);
    rows.clear();
    const loads::Sight sight = sight_of(model, k, t, around, ends);
    const bool is_off = around.memory != nullptr && around.memory->is_off(k);
    int regime = 0;
    citing(load, [&] {
      if (has_regimes(load) && !is_off) {
        regime = load.element->append_tangent_in_regime(sight, rows);
        out.regimes.push_back(regime);
        return;
      }
      load.element->append_tangent(sight, rows);
      if (is_off) give_nothing(rows);
      if (has_regimes(load)) out.regimes.push_back(0);
    });
    if (followers != nullptr && !is_off) {
      followers->append(k, static_cast<int>(out.rows.size()), regime, sight, around, ends.travels(),
                        *slopes);
    }
    if (!is_off && load.coordinate >= 0 && load.element->uses_signals()) {
      add_slopes_of_signals(load, motions, around, {model, sight, out});
    }
    if (!is_off) append_mix(*load.element, sight, out);
    append_rows_of(model, load, ends, sight, out);
  }
  append_group_tangents(model, motions, t, around, out);
}

}  // namespace buckens::dynamics
