// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/impacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/dynamics/model_scales.h"
#include "buckens/dynamics/travel.h"
#include "buckens/stepping/friction_impulses.h"
#include "buckens/stepping/gap_of_step.h"
#include "buckens/stepping/mesh_partners.h"
#include "buckens/stepping/rigid_rows.h"
#include "buckens/stepping/step_failure.h"
#include "buckens/stepping/tooth_space.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

// If a rate at the instant of the impact differs from that at the end of the step by more than this
// fraction, it is that of another contact point.
constexpr double kSamePlace = 0.1;
// Overlaps of this fraction of the size of positions, or [rad], are rounding.
constexpr double kNoGap = 1e-14;
// What joints leave of the response along a row, as a fraction of that of its own bodies: less is
// rounding.
constexpr double kYields = 1e-12;

[[noreturn]] void refuse_unyielding(const model::Model& model) {
  const auto& bodies = model.bodies;
  const auto quasi_static = std::find_if(bodies.begin(), bodies.end(), [](const body::Body& body) {
    return body.is_flexible() && body.flexible->is_quasi_static;
  });
  if (quasi_static == bodies.end()) {
    throw StepFailure(
        "no impulse stops what strikes it, because joints and drives hold all that it could move; "
        "give it a `stiffness`, or drive with a limited force");
  }
  throw StepFailure(fmt::format(
      "no impulse stops what strikes it, because joints and drives hold all that it could move, "
      "and the quasi-static body \"{}\" does not yield to a blow; give it a `stiffness`, drive "
      "with a limited force, or make the body `flexibility: elastic`",
      quasi_static->name));
}

}  // namespace

Impacts::Impacts(const model::Model& model, const Scheme& scheme,
                 std::vector<const BodyAnswer*> answers)
    : model_(model),
      scheme_(scheme),
      answers_(std::move(answers)),
      islands_(model),
      answers_to_(model),
      clearance_(model) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    if (model.loads[k].rigid_row < 0) continue;
    const auto* law = static_cast<const loads::RigidLaw*>(model.loads[k].element.get());
    if (law->contact(0.0).regime != 0) laws_.push_back({k, law, {}, {}, true});
    const auto* friction = dynamic_cast<const loads::ContactFriction*>(law);
    if (friction == nullptr && law->contact(0.0).regime == 0) holds_.push_back(k);
    if (friction == nullptr) continue;
    laws_.back().frictions.push_back({k, friction});
    is_rough_ = true;
  }
  if (laws_.empty()) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    interface_.push_back(impulse_compliance(scheme, answers_[b]));
    jumps_.emplace_back();
  }
  with_mesh_ = mesh_partners(model);
  is_free_.assign(model.bodies.size(), 1);
  for (const model::Joint& joint : model.joints) {
    for (const int body : bodies_of(model, joint)) is_free_[static_cast<std::size_t>(body)] = 0;
  }
}

bool Impacts::moves_mesh(const Law& law) const {
  const model::Load& load = model_.loads[law.load];
  const auto moves = [&](int body) {
    return body != model::kGround && with_mesh_[static_cast<std::size_t>(body)] != 0;
  };
  return moves(load.first.body) || moves(load.second.body);
}

Matrix Impacts::impulse_compliance(const Scheme& scheme, const BodyAnswer* answer) {
  if (answer == nullptr || answer->is_quasi_static()) return {};
  return scheme.force * scheme.acceleration_rate * answer->interface_compliance();
}

namespace {

loads::CoordinateMotion motion_of(const model::Model& model, const model::Load& load,
                                  const std::vector<dynamics::BodyMotion>& motions, double t,
                                  const model::RowMemory& memory) {
  return dynamics::coordinate_motion(model, static_cast<std::size_t>(load.coordinate), t, &memory,
                                     motions);
}

}  // namespace

void Impacts::start(const std::vector<dynamics::BodyMotion>& motions, double t,
                    const model::RowMemory& memory) {
  for (Law& law : laws_) {
    law.start = motion_of(model_, model_.loads[law.load], motions, t, memory);
    law.bounces = true;
  }
  if (can_happen()) start_ = motions;
}

bool Impacts::find(const std::vector<dynamics::BodyMotion>& motions,
                   const std::vector<BodyStep>& bodies, const std::vector<int>& rows_in_use,
                   const dynamics::Circumstances& around, double t) {
  touches_.clear();
  slips_.clear();
  landings_.clear();
  length_ = dynamics::rounding_length(model_, motions);
  shares_.clear();
  loss_ = 0;
  count_ = jammed_ = 0;
  signals_ = dynamics::signals_of(around);
  bool is_struck = false;
  for (std::size_t k = 0; k < laws_.size(); ++k)
    is_struck = look(k, around, motions, t) || is_struck;
  if (!is_struck) return false;
  find_islands();
  // What the impact presses together, such as a stack on the floor, is hit at the same instant.
  for (Touch& touch : touches_) {
    // What it holds on a mesh continues from there as well.
    const bool goes_on = touch.stays && !touch.strikes && moves_mesh(laws_[touch.law]);
    if (goes_on) touch.rest = strongest_near(touch).rest;
    if (touch.stays || touch.approach > 0.0 || touch.is_of_step) continue;
    touch.stays = true;
    touch.rest = strongest_near(touch).rest;
  }
  std::vector<dynamics::BodyMotion> then = at_impact(motions);
  find_instants();
  condense(then, bodies, rows_in_use, around, t);
  MotionPair kept;
  for (Touch& touch : touches_) {
    const double most = std::abs(strongest_near(touch).rate);
    go_to_instant(touch, motions, then, kept);
    set_row(laws_[touch.law].load, touch.sign, then, around.memory, touch);
    const double rate = rate_of(touch.row, then);
    leave_instant(touch, then, kept);
    const auto is_other = [&](double known) {
      return std::abs(rate - known) > kSamePlace * std::max(most, std::abs(rate));
    };
    // Round bodies that graze each other have different rates at both instants, at the same
    // contact point.
    const bool is_met = touch.strikes && !touch.stays && !is_other(-touch.approach);
    touch.is_elsewhere = is_other(touch.rate) && !is_met;
    if (touch.is_elsewhere) take_row_of_end(touch, motions, around.memory);
    answers_to_.answer(touch);
  }
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    go_to_instant(touches_[k], motions, then, kept);
    add_slips(k, touches_[k].is_elsewhere ? motions : then, around.memory);
    leave_instant(touches_[k], then, kept);
  }
  return strike(then, rows_in_use, around.memory, t) ||
         find(motions, bodies, rows_in_use, around, t);
}

bool Impacts::strike(const std::vector<dynamics::BodyMotion>& then,
                     const std::vector<int>& rows_in_use, const model::RowMemory* memory,
                     double t) {
  try {
    const linalg::SparseMatrix D = answers();
    for (std::size_t k = 0; k < touches_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double own = own_compliance(touches_[k].row, compliance_);
      if (touches_[k].strikes && !(D.coeff(i, i) > kYields * own)) refuse_unyielding(model_);
    }
    std::vector<Eigen::Index> jammed;
    Vector P = solve(D, &jammed);
    if (!jammed.empty()) {
      if (stop_bouncing(jammed)) return false;
      P = solve(D, nullptr);  // throws, saying what cannot be solved
    }
    const Vector jump = D * P;
    if (stop_bouncing(gaining(P, jump, then))) return false;
    share_instants(P);
    move_bodies(P);
    land(P, jump);
    lose(P, jump, then);
    clear_ends(P, then, rows_in_use, memory, t);
  } catch (const StepFailure& failure) {
    const model::Load& load = model_.loads[laws_[touches_.front().law].load];
    throw StepFailure(fmt::format("{} \"{}\" at t = {:.6g} s: {}",
                                  load.is_among_joints ? "joint" : "load", load.name, t,
                                  failure.what()));
  }
  return true;
}

bool Impacts::stop_bouncing(const std::vector<Eigen::Index>& rows) {
  bool is_news = false;
  for (const Eigen::Index row : rows) {
    if (row >= std::ssize(touches_)) continue;
    const Touch& touch = touches_[static_cast<std::size_t>(row)];
    bool& bounces = laws_[touch.law].bounces;
    is_news = is_news || (bounces && !touch.stays);
    bounces = false;
  }
  return is_news;
}

linalg::SparseMatrix Impacts::answers() const {
  std::vector<const Push*> pushes;
  for (std::size_t k = 0; k < num_pushes(); ++k) pushes.push_back(&push(k));
  return PushAnswers::along_all(pushes);
}

Vector Impacts::solve(const linalg::SparseMatrix& D, std::vector<Eigen::Index>* jammed) {
  are_near_ = false;
  Vector b(static_cast<Eigen::Index>(num_pushes()));
  for (std::size_t row = 0; row < num_pushes(); ++row) {
    b[static_cast<Eigen::Index>(row)] =
        row < touches_.size() ? touches_[row].target : -slips_[row - touches_.size()].speed;
  }
  std::vector<ImpactSlip> slips;
  for (std::size_t k = 0; k < slips_.size(); ++k) {
    const auto across = static_cast<Eigen::Index>(slips_[k].touch);
    if (slips_[k].friction > 0) {
      ++slips.back().count;
      continue;
    }
    double square = 0;
    for (std::size_t m = k; m < slips_.size() && slips_[m].touch == slips_[k].touch; ++m) {
      square += slips_[m].at_impact * slips_[m].at_impact;
    }
    slips.push_back({across, static_cast<Eigen::Index>(touches_.size() + k), 1,
                     friction_of(slips_[k]).law->data_at(signals_).coefficient(std::sqrt(square))});
  }
  return solve_impact(D, b, static_cast<Eigen::Index>(touches_.size()), slips, jammed, &are_near_);
}

/// Adds the directions in which friction of a stop that is reached acts.
/// @param then motions there, with the velocities of the end of the step
void Impacts::add_slips(std::size_t index, const std::vector<dynamics::BodyMotion>& then,
                        const model::RowMemory* memory) {
  const Touch& touch = touches_[index];
  const std::vector<Friction>& frictions = laws_[touch.law].frictions;
  for (std::size_t k = 0; k < frictions.size(); ++k) {
    Slip slip;
    slip.touch = index;
    slip.friction = k;
    set_row(frictions[k].load, 1.0, then, memory, slip);
    const double end = rate_of(slip.row, then);
    const double start = rate_of(slip.row, start_);
    slip.at_impact = touch.is_of_step ? start : end + touch.since / scheme_.h * (start - end);
    slip.speed = touch.stays || touch.is_of_step ? end : slip.at_impact;
    answers_to_.answer(slip);
    slips_.push_back(std::move(slip));
  }
}

/// Adds the end that a law touches, if it does. @return whether it strikes there
bool Impacts::look(std::size_t index, const dynamics::Circumstances& around,
                   const std::vector<dynamics::BodyMotion>& motions, double t) {
  const Law& law = laws_[index];
  const model::Load& load = model_.loads[law.load];
  if (around.memory != nullptr && around.memory->is_off(law.load)) return false;
  const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, around.memory);
  const loads::Sight sight = dynamics::sight_of(model_, law.load, t, around, ends);
  const double fastest = std::max(std::abs(law.start.rate), std::abs(sight.coordinate.rate));
  require_same_space(load, fastest, scheme_.h);
  loads::RigidLaw::Contact contact = law.law->contact(sight.coordinate.value);
  const bool is_closed = sight.stand.regime != 0;
  if (is_closed) contact.regime = sight.stand.regime;
  const double sign = contact.sign;
  if (!is_closed && !(contact.gap < 0.0)) return false;
  // What already lies there is displaced by rounding, and approaches as slowly.
  const bool is_length =
      !model_.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
  const double rounding = kNoGap * (is_length ? length_ : 1.0);
  const double way = std::min(contact.gap, scheme_.h * sign * sight.coordinate.rate);
  if (!is_closed && way >= -rounding) return false;
  const bool strikes = !is_closed && sign * sight.coordinate.rate < 0.0;
  Touch touch;
  touch.law = index;
  touch.regime = contact.regime;
  touch.strikes = strikes;
  touch.stays = is_closed;
  touch.rate = sign * sight.coordinate.rate;
  touch.gap = contact.gap;
  if (strikes) {
    const double rate_start = sign * law.start.rate;
    const bool is_on_mesh = moves_mesh(law);
    // Pressed against its stop, an end of a mesh arrives anew in every step, at the speed that the
    // force gives to what little it moves. It is at rest if it has none when the step begins.
    const bool rests = is_on_mesh && restitution(law, std::abs(rate_start)) == 0.0;
    const double e = rests ? 0.0 : restitution(law, -touch.rate);
    set_approach(touch, law, rests, sight.coordinate, sign, contact.gap);
    if (e > 0.0 && is_on_mesh) {
      // What has reversed within the step comes back as fast as it left at most: this takes no
      // work, because its net displacement is zero.
      if (rate_start >= 0.0 && touch.rate >= -rate_start) return false;
      make_impulse_of_step(touch, rate_start < 0.0 ? e : 1.0, rate_start);
    }
  } else {
    touch.target = -touch.rate;
  }
  touch.sign = sign;
  touches_.push_back(std::move(touch));
  return strikes;
}

void Impacts::set_row(std::size_t index, double sign,
                      const std::vector<dynamics::BodyMotion>& motions,
                      const model::RowMemory* memory, Push& push) const {
  const model::Load& load = model_.loads[index];
  const auto coordinate = static_cast<std::size_t>(load.coordinate);
  const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, memory);
  const joints::JointCoordinate& law = model_.coordinates[coordinate].law;
  const spatial::PairRow J = ends.travel ? ends.travel->coordinate(coordinate, memory).J
                                         : law.derivatives(ends.first.motion, ends.second.motion,
                                                           dynamics::before_of(memory, coordinate));
  dynamics::row_of(model_, load, ends, J, push.row);
  for (std::size_t k = 0; k < push.row.num_parts(); ++k) {
    push.row.part(k).frame *= sign;
    push.row.part(k).interface *= sign;
  }
}

double Impacts::restitution(const Law& law, double approach) const {
  return law.bounces ? law.law->restitution(approach, signals_) : 0.0;
}

void Impacts::set_approach(Touch& touch, const Law& law, bool rests,
                           const loads::CoordinateMotion& end, double sign, double gap) const {
  const double rate_end = sign * end.rate;
  GapOfStep way{gap - sign * end.change, sign * law.start.rate, gap, rate_end, scheme_.h};
  // At another contact point than at the end: it arrives with the rate that it has there.
  if (way.begins_elsewhere()) {
    way.start = gap - scheme_.h * rate_end;
    way.rate_start = rate_end;
  }
  const double s = way.closes_at();
  touch.approach = std::max(0.0, -way.likely_rate_at(s));
  touch.rest = touch.since = (1.0 - s) * scheme_.h;
  const double e = rests ? 0.0 : restitution(law, touch.approach);
  touch.met = -touch.approach;
  touch.target = (1.0 + e) * touch.approach;
  // What returns within the step in which it left, or would not leave at all, stays.
  const bool has_just_left = way.rate_start > 0.0;
  touch.stays = e == 0.0 || has_just_left || rate_end + touch.target <= 0.0;
  if (!touch.stays) return;
  // It rests at the end of the step, and exactly there.
  touch.lost_share = touch.approach * touch.approach / (rate_end * rate_end);
  touch.target = -rate_end;
  touch.approach = -rate_end;
  touch.met = rate_end;
  touch.rest = std::min(-gap / touch.target, scheme_.h);
}

void Impacts::take_row_of_end(Touch& touch, const std::vector<dynamics::BodyMotion>& end,
                              const model::RowMemory* memory) {
  const Law& law = laws_[touch.law];
  set_row(law.load, touch.sign, end, memory, touch);
  if (!touch.strikes || touch.stays || touch.is_of_step) return;
  touch.approach = -touch.rate;
  touch.target = (1.0 + restitution(law, touch.approach)) * touch.approach;
}

void Impacts::make_impulse_of_step(Touch& touch, double e, double rate_start) const {
  touch.is_of_step = true;
  touch.stays = false;
  touch.lost_share = 1.0;
  touch.approach = -rate_start;
  touch.met = touch.rate;
  touch.target = -e * rate_start - touch.rate;
  // To Δẋ the method adds Δx = Δẋ/s₁, as if the impulse acted throughout the step.
  touch.rest = 1.0 / scheme_.end_rate;
}

void Impacts::find_holding(const std::vector<dynamics::BodyMotion>& motions,
                           const dynamics::Circumstances& around, double t) {
  holding_.clear();
  for (const std::size_t k : holds_) {
    const model::Load& load = model_.loads[k];
    if (around.memory != nullptr && around.memory->is_off(k)) continue;
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, around.memory);
    const loads::Sight sight = dynamics::sight_of(model_, k, t, around, ends);
    const auto& law = static_cast<const loads::RigidLaw&>(*load.element);
    if (!law.withstands_impacts(sight)) continue;
    Push push;
    set_row(k, 1.0, motions, around.memory, push);
    holding_.push_back(std::move(push.row));
  }
}

void Impacts::condense(const std::vector<dynamics::BodyMotion>& motions,
                       const std::vector<BodyStep>& bodies, const std::vector<int>& rows_in_use,
                       const dynamics::Circumstances& around, double t) {
  compliance_.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const Eigen::Matrix3d J = body.is_flexible() ? bodies[b].moments(body, motions[b]).J : body.J0;
    compliance_[b].frame = dynamics::frame_mobility(body, J);
    compliance_[b].interface = interface_[b].size() > 0 ? &interface_[b] : nullptr;
  }
  find_holding(motions, around, t);
  if (answers_to_.condense(compliance_, motions, rows_in_use, around.memory, t, holding_)) return;
  throw StepFailure(
      fmt::format("the joint equations have become dependent (a singular position) at an impact at "
                  "t = {:.6g} s; look for a dead centre of the mechanism there",
                  t));
}

void Impacts::clear_ends(const Vector& P, const std::vector<dynamics::BodyMotion>& then,
                         const std::vector<int>& rows_in_use, const model::RowMemory* memory,
                         double t) {
  Push moved;
  for (std::size_t b = 0; b < jumps_.size(); ++b) {
    moved.bodies.push_back({b, jumps_[b].shift, Vector::Zero(jumps_[b].impulse.size()), {}});
  }
  for (std::size_t k = 0; k < num_pushes(); ++k) {
    const Touch& touch = touches_[k < touches_.size() ? k : slips_[k - touches_.size()].touch];
    for (const PushedBody& own : push(k).bodies) {
      moved.bodies[own.body].y += (P[static_cast<Eigen::Index>(k)] * touch.rest) * own.y;
    }
  }
  std::vector<StopClearance::End> ends;
  for (const Touch& touch : touches_) {
    if (!touch.is_of_step) continue;
    ends.push_back({touch.row, touch.gap + PushAnswers::along(touch.row, moved)});
  }
  const auto shifts = clearance_.find(ends, compliance_, then, rows_in_use, holding_, memory, t);
  for (std::size_t b = 0; b < shifts.size(); ++b) {
    jumps_[b].shift += shifts[b].frame;
    if (shifts[b].impulse_time.size() > 0) jumps_[b].impulse_time += shifts[b].impulse_time;
  }
}

void Impacts::land(const Vector& P, const Vector& jump) {
  double size = 0;  // of rates, to tell them from rounding
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const double change = jump[static_cast<Eigen::Index>(k)];
    size = std::max(size, std::abs(touches_[k].rate) + std::abs(change));
  }
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Touch& touch = touches_[k];
    const auto i = static_cast<Eigen::Index>(k);
    // What has reversed within the step does not approach at its start.
    if (touch.approach > 0.0 || (touch.is_of_step && P[i] > 0.0)) {
      ++count_;
      const Law& law = laws_[touch.law];
      const bool is_jammed = touch.strikes && !law.bounces;
      if (is_jammed && law.law->restitution(touch.approach, signals_) > 0.0) ++jammed_;
    }
    // Driven off by others, or leaving with restitution: no longer held.
    const bool leaves = touch.rate + jump[i] > std::max(1e-9 * size, weight_returns(touch));
    const bool is_held = touch.stays && !leaves;
    const int rigid_row = model_.loads[laws_[touch.law].load].rigid_row;
    landings_.push_back({rigid_row, is_held ? touch.regime : 0});
    land_slips(k, is_held, jump);
  }
}

double Impacts::weight_returns(const Touch& touch) const {
  const model::Load& load = model_.loads[laws_[touch.law].load];
  const bool is_angle =
      model_.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
  return is_angle ? 0.0 : dynamics::gravity_at(model_, signals_).norm() * scheme_.h;
}

/// Whether bodies that stay together stick or slide.
void Impacts::land_slips(std::size_t touch, bool is_held, const Vector& jump) {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < slips_.size(); ++k) {
    if (slips_[k].touch != touch) continue;
    before += std::abs(slips_[k].speed);
    after += std::abs(slips_[k].speed + jump[static_cast<Eigen::Index>(touches_.size() + k)]);
  }
  for (const Friction& friction : laws_[touches_[touch].law].frictions) {
    const bool sticks = after <= std::max(friction.law->data().at_rest, Slip::kStopped * before);
    landings_.push_back({model_.loads[friction.load].rigid_row, !is_held ? 0 : sticks ? 1 : 2});
  }
}

}  // namespace buckens::stepping
