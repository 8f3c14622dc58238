// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "buckens/dynamics/model_scales.h"
#include "buckens/stepping/body_iteration.h"
#include "buckens/stepping/lagged_coupling.h"

namespace buckens::stepping {

using linalg::Vector;
using strand::BodyRows;
using strand::kLanes;
using strand::MeshRows;
using strand::Plane;
using strand::Space;

namespace {

// Squares of half an angle up to which the series of rotations hold.
constexpr double kFurthestTurn = 0.25;
// Along a chain that nothing bends out of its plane, rounding of the elimination grows with the
// cube of the number of links and makes pivots negative from some 50 000 on. Joints that yield by
// this share of what they yield alone end the growth after some thousand links. Residuals are
// exact, so that this changes the rate of the iteration (by 1e-3 at most, in extension), not where
// it leads.
constexpr std::size_t kLongChain = 20000;  // joints
constexpr double kYield = 1e-13;
// Gaps up to the inverse of this share of what the iteration may leave are roundings of positions,
// some five units of their last digit, and stay.
constexpr double kFewRoundings = 2.0;

}  // namespace

std::unique_ptr<StrandStep> StrandStep::make(const model::Model& model,
                                             const StepSettings& settings, const Scheme& scheme,
                                             const StrandMechanism::Operators& operators) {
  if (!settings.side_by_side || !StrandMechanism::suits(model, scheme, operators)) return nullptr;
  return std::make_unique<StrandStep>(model, settings, scheme, operators);
}

StrandStep::StrandStep(const model::Model& model, const StepSettings& settings,
                       const Scheme& scheme, const StrandMechanism::Operators& operators)
    : model_(model),
      settings_(settings),
      scheme_(scheme),
      mechanism_(model, scheme, operators, settings.simd),
      loads_(model, mechanism_),
      kernels_(mechanism_.kernels()),
      forecast_(scheme, model.length),
      watch_(model),
      all_rows_(static_cast<std::size_t>(model.num_constraint_rows())),
      is_touched_(model.bodies.size(), 0),
      ending_(settings, model.length, dynamics::shortest_lever(model)),
      solves_(model.bodies.size(), 0),
      motions_(model.bodies.size()) {
  std::iota(all_rows_.begin(), all_rows_.end(), 0);
  for (const model::Coordinate& coordinate : model.coordinates) {
    for (const model::MarkerId* id : {&coordinate.first, &coordinate.second}) {
      if (id->body != model::kGround) is_touched_[static_cast<std::size_t>(id->body)] = 1;
    }
  }
  const auto rows = model.num_constraint_rows();
  for (Vector* v : {&residuals_.g, &residuals_.g_dot, &E_, &X_}) v->setZero(rows);
}

bool StrandStep::takes(const model::State& state, const std::vector<int>& rows_in_use) const {
  if (rows_in_use != all_rows_ || state.lambda.size() != std::ssize(all_rows_)) return false;
  const auto& released = state.memory.released;
  if (std::any_of(released.begin(), released.end(), [](char is) { return is != 0; })) return false;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const Eigen::Quaterniond& q = state.bodies[b].frame.X_WB.q;
    if (mechanism_.is_planar() && (q.x() != 0.0 || q.y() != 0.0)) return false;
    if (body.is_flexible() && state.bodies[b].terms != body.flexible->coupling.terms) return false;
  }
  return true;
}

void StrandStep::move_body(std::size_t block) {
  furthest_ =
      larger(furthest_, kernels_.move(mechanism_.constants(), mechanism_.body_blocks()[block]));
}

void StrandStep::evaluate_joint(std::size_t block) {
  kernels_.evaluate_joints(mechanism_.joint_blocks()[block], residuals_.g.data(),
                           residuals_.g_dot.data());
}

void StrandStep::balance_bodies(const model::State& state, bool finds_residuals) {
  loads_.evaluate(state, scheme_.evaluation_time(state.t));
  open_ = 0;
  for (strand::BodyBlock& block : mechanism_.body_blocks()) {
    kernels_.collect(mechanism_.constants(), block);
    if (!finds_residuals) continue;
    open_ = larger(open_, kernels_.find_residual(mechanism_.constants(), block));
  }
}

bool StrandStep::turns_too_far() const { return !(furthest_ <= kFurthestTurn); }

template <class S>
bool StrandStep::prepare(const model::State& state) {
  furthest_ = 0;
  mechanism_.sweep().bodies_first(
      [&](std::size_t k) { load_block<S>(state, k); }, [&](std::size_t k) { evaluate_joint(k); },
      [&](std::size_t k) { kernels_.freeze(mechanism_.constants(), mechanism_.body_blocks()[k]); },
      [&](std::size_t k) { kernels_.freeze_joints(mechanism_.joint_blocks()[k]); });
  if (turns_too_far()) return false;
  linalg::BlockLu& matrix = mechanism_.matrix();
  matrix.clear();
  for (const strand::PairBlock& block : mechanism_.pair_blocks()) kernels_.add_pairs(block);
  if (model_.joints.size() > kLongChain) {
    for (const int row : all_rows_) matrix.diagonal(row) *= 1 + kYield;
  }
  return matrix.factorise() && matrix.pivot_ratio() >= kWeaklyHeld;
}

bool StrandStep::move(StepReport& report, Change& change) {
  const strand::Constants& is = mechanism_.constants();
  const strand::Sweep& sweep = mechanism_.sweep();
  std::vector<strand::BodyBlock>& bodies = mechanism_.body_blocks();
  std::vector<strand::JointBlock>& joints = mechanism_.joint_blocks();
  E_ = residuals_.g_dot / scheme_.end_rate - residuals_.g;
  double gap = 0;
  for (const int row : all_rows_) {
    gap = larger(gap, std::abs(E_[row]) * (watch_.is_length(row) ? 1.0 : model_.length));
  }
  // A correction does not close the rounding of positions: it turns short links to and fro, and the
  // iteration with them.
  if (ending_.is_rounding({kFewRoundings * gap, 0.0})) {
    E_.setZero();
  } else {
    mechanism_.matrix().solve_in_place(E_);
  }
  sweep.joints_first([&](std::size_t k) { kernels_.apply(joints[k], E_.data()); },
                     [&](std::size_t k) { kernels_.correct(is, bodies[k]); },
                     [&](std::size_t k) { kernels_.find_changes(joints[k], X_.data()); });
  X_ = -X_ - residuals_.g_dot / scheme_.end_rate;
  mechanism_.matrix().solve_in_place(X_);
  lambda_ += X_ / scheme_.force;
  mechanism_.is_planar() ? put_multipliers<Plane>() : put_multipliers<Space>();
  change = {};
  double interface = 0;
  furthest_ = 0;
  sweep.joints_first([&](std::size_t k) { kernels_.apply(joints[k], X_.data()); },
                     [&](std::size_t k) {
                       const strand::Largest moved = kernels_.advance(is, bodies[k]);
                       change.size = larger(change.size, moved.frame);
                       interface = larger(interface, moved.interface);
                       change.motion = larger(change.motion, moved.motion);
                       move_body(k);
                     },
                     [&](std::size_t k) { evaluate_joint(k); });
  change.size = larger(change.size, interface);
  ++report.newton_iterations;
  motion_ = change.motion;
  return change.size < HUGE_VAL && !turns_too_far();
}

template <class S>
void StrandStep::put_multipliers() {
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    double* const at = mechanism_.multipliers(j);
    const model::Joint& joint = model_.joints[j];
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      at[kLanes * k] = lambda_[joint.first_row + static_cast<int>(k)];
    }
  }
}

bool StrandStep::is_balanced(double motion) const {
  const double enough = ending_.negligible(motion);
  if (!(open_ <= enough)) return false;
  for (std::size_t row = 0; row < all_rows_.size(); ++row) {
    const auto k = static_cast<Eigen::Index>(row);
    const double length = watch_.is_length(static_cast<int>(row)) ? 1.0 : model_.length;
    if (!(std::abs(residuals_.g_dot[k]) * length <= enough * scheme_.end_rate)) return false;
    if (!(std::abs(residuals_.g[k]) * length <= enough)) return false;
  }
  return true;
}

bool StrandStep::settle(const model::State& state, StepReport& report, Change change,
                        bool goes_on) {
  Change before;
  has_left_open_ = false;
  for (int iteration = 1;; ++iteration) {
    const bool is_settled = ending_.is_settled(change, before, mechanism_.matrix().pivot_ratio());
    balance_bodies(state, !is_settled);
    record_residuals(residuals_, report);
    if (is_settled) break;
    if (iteration <= settings_.max_newton && is_balanced(change.motion)) break;
    has_left_open_ = goes_on && ending_.is_near(change, before.size);
    if (has_left_open_) return true;
    before = change;
    if (iteration >= settings_.max_newton || !move(report, change)) return false;
  }
  return watch_.look(residuals_, all_rows_, report) < 0;
}

template <class S>
CouplingRounds::Gap StrandStep::compare_coupling() {
  using Row = MeshRows<S>;
  CouplingRounds::Gap out;
  for (strand::BodyBlock& block : mechanism_.body_blocks()) {
    kernels_.complete(mechanism_.constants(), block);
    kernels_.evaluate_coupling(mechanism_.constants(), block);
  }
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    double* const t = mechanism_.body(b).at;
    if (!mechanism_.body(b).has_mesh) continue;
    const auto number = [&](int row) -> double& { return t[kLanes * row]; };
    const auto norm = [&](int first, int count) {
      double sum = 0;
      for (int k = 0; k < count; ++k) sum += number(first + k) * number(first + k);
      return std::sqrt(sum);
    };
    LaggedCoupling::Change change;
    change.load = std::sqrt(number(Row::changed));
    change.load_size = std::sqrt(number(Row::size));
    change.moved = number(Row::moved);
    change.frame = norm(Row::fc, S::R);
    change.turned = norm(Row::turned, S::R);
    double w_dot = 0, w = 0;
    for (int k = 0; k < S::R; ++k) {
      const double acceleration =
          scheme_.acceleration_rate * number(Row::u + k) + number(Row::acc + k);
      w_dot += acceleration * acceleration;
      w += number(Row::we + k) * number(Row::we + k);
    }
    change.frame_size = model_.bodies[b].J0.norm() * (std::sqrt(w_dot) + w);
    const LaggedCoupling::Gap gap =
        LaggedCoupling::judge(change, model_.bodies[b], settings_, model_.length);
    number(Row::mask) = gap.load_changed ? 1.0 : 0.0;
    out.is_settled = out.is_settled && gap.is_settled();
    out.motion = std::max(out.motion, gap.motion);
    if (!(gap.change <= out.change)) out.change = std::max(out.change, gap.change);
  }
  return out;
}

bool StrandStep::close(const model::State& state, StepReport& report, Change& change) {
  if (!has_left_open_) return true;
  if (!move(report, change) || !settle(state, report, change)) return false;
  for (strand::BodyBlock& block : mechanism_.body_blocks()) {
    kernels_.complete(mechanism_.constants(), block);
  }
  return true;
}

template <class S>
bool StrandStep::compute(const model::State& state, StepReport& report) {
  using Row = MeshRows<S>;
  if (!prepare<S>(state)) return false;
  ending_.begin(rounding_length<S>());
  lambda_ = state.lambda;
  if (forecast_.foretells(state)) apply_forecast<S>(state);
  put_multipliers<S>();
  furthest_ = 0;
  mechanism_.sweep().bodies_first([&](std::size_t k) { move_body(k); },
                                  [&](std::size_t k) { evaluate_joint(k); });
  if (turns_too_far()) return false;
  balance_bodies(state, true);
  record_residuals(residuals_, report);
  Change change;
  if (!move(report, change) || !settle(state, report, change, state.had_rounds)) return false;
  CouplingRounds rounds(settings_);
  bool has_meshes = false;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (!mechanism_.body(b).has_mesh) continue;
    has_meshes = true;
    ++solves_[b];
  }
  if (has_meshes) report.large_solve_rounds = 1;
  for (had_rounds_ = false;; had_rounds_ = true) {
    const CouplingRounds::Gap gap = compare_coupling<S>();
    report.coupling_change = gap.change;
    const auto verdict = rounds.judge(gap, report.large_solve_rounds);
    if (verdict == CouplingRounds::Verdict::ends) return close(state, report, change);
    if (verdict == CouplingRounds::Verdict::fails) return false;
    bool any_solves = false;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const StrandMechanism::Place& place = mechanism_.body(b);
      if (!place.has_mesh || place.at[kLanes * Row::mask] == 0.0) continue;
      any_solves = true;
      ++solves_[b];
    }
    if (any_solves) ++report.large_solve_rounds;
    open_ = 0;
    for (strand::BodyBlock& block : mechanism_.body_blocks()) {
      kernels_.take_over(mechanism_.constants(), block);
      open_ = larger(open_, kernels_.find_residual(mechanism_.constants(), block));
    }
    if (!has_left_open_ && open_ <= ending_.negligible(motion_)) continue;
    if (!move(report, change) || !settle(state, report, change)) return false;
  }
}

bool StrandStep::step(const model::State& state, model::State& next, StepReport& report) {
  const bool is_planar = mechanism_.is_planar();
  if (!(is_planar ? compute<Plane>(state, report) : compute<Space>(state, report))) return false;
  is_planar ? write<Plane>(state, next) : write<Space>(state, next);
  next.had_rounds = had_rounds_;
  return true;
}

}  // namespace buckens::stepping
