// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/stepper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/stepping/change_of_step.h"
#include "buckens/stepping/lowest_frequency.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Vector;

namespace {
// Positions are known to rounding, accelerations to that over h². A coupling load that falls no
// further from solve to solve has been reached, whatever the outer tolerance asks for, if what is
// left is this small: relative to the load, or as motion relative to the model's length (where a
// motion has barely begun).
constexpr double kCouplingRounding = 1e-9;
constexpr double kPositionRounding = 1e-15;
// What a second large solve may leave in the coupling load: its share of the motion in a step is
// smaller by (h ω)² than that, far below what the method itself neglects.
constexpr double kSecondSolve = 1e-4;
// Where the coupling load passes through zero, what matters is the motion that the rest would cause
// in the step, relative to the model's length.
constexpr double kSecondSolveMotion = 1e-9;
// A coupling load this much smaller than the body's other inertia loads need not be known to the
// outer tolerance of itself: what matters is its share in the motion.
constexpr double kLeastShare = 1e-3;
// Ends of steps are counted by others, not summed.
constexpr double kSameInstant = 1e-6;
// Fewer variables in all bodies together are not worth waking a thread for.
constexpr Eigen::Index kSharedDofs = 2000;
constexpr int kPartsPerThread = 4;
}  // namespace

/// The n-sized share of one flexible body in a step.
struct Stepper::Large {
  explicit Large(const BodyStepOperator& op)
      : inverse_diagonal(op.K_hat_diagonal().cwiseInverse()), has_rates(!op.is_quasi_static()) {}

  History<Vector> history;
  model::Coupling used;       // what the step was computed with
  model::Coupling evaluated;  // what its result gives
  Vector free;                // end value without interface loads
  Vector d_end;               // end value
  Vector increment;           // Δ: end value without correction, minus the start
  Vector inverse_diagonal;    // of K̂: measures loads
  bool has_rates;             // quasi-static bodies deform without
  bool load_changed = true;
  // Where the equations hold; `difference` of coupling loads and the load of the undeformed body.
  Vector d_e, rate_e, acceleration_e, difference, undeformed;

  void evaluate_acceleration(const Scheme& scheme) {
    acceleration_e = scheme.acceleration_rate * increment + history.acceleration;
    if (!has_rates) acceleration_e.setZero();
  }
  double norm(const Vector& load) const {
    return std::sqrt(load.cwiseAbs2().dot(inverse_diagonal));
  }
  /// Largest displacement (before the factor c) by a load, estimated from the diagonal of K̂.
  double moved_by(const Vector& load) const {
    return load.cwiseProduct(inverse_diagonal).cwiseAbs().maxCoeff();
  }
};

/// Bodies whose solves read the same factor, so that they go together as right-hand sides.
struct Stepper::FactorGroup {
  const linalg::SparseCholesky* factor = nullptr;
  std::vector<std::size_t> bodies;
  std::vector<std::size_t> active;  // those that solve in this round
  linalg::Matrix sides;

  void solve(std::vector<std::unique_ptr<Large>>& large, TaskPool* pool,
             linalg::SolveExchange* exchange) {
    if (active.empty()) return;
    if (active.size() == 1 && exchange == nullptr) {
      factor->solve_in_place(large[active.front()]->free, pool);
      return;
    }
    const auto count = static_cast<Eigen::Index>(active.size());
    // An exchange takes all columns; alone, room for all bodies serves any number of them.
    sides.resize(factor->size(),
                 exchange != nullptr ? count : static_cast<Eigen::Index>(bodies.size()));
    for (std::size_t k = 0; k < active.size(); ++k) {
      sides.col(static_cast<Eigen::Index>(k)) = large[active[k]]->free;
    }
    if (exchange != nullptr) {
      exchange->solve(*factor, sides, pool);
    } else {
      factor->solve_first(sides, count, pool);
    }
    for (std::size_t k = 0; k < active.size(); ++k) {
      large[active[k]]->free = sides.col(static_cast<Eigen::Index>(k));
    }
  }
};

/// How far the coupling of one body is from what the step was computed with.
struct Stepper::CouplingGap {
  bool is_settled = true;
  double change = 0;  // relative
  double motion = 0;  // that it causes, relative to the model's length
};

namespace {

/// @param known operators of other bodies, one of which may have the factor already
std::unique_ptr<BodyStepOperator> factorised(
    const body::Body& body, const Scheme& scheme,
    const std::vector<std::unique_ptr<BodyStepOperator>>& known, linalg::SolveExchange* exchange) {
  if (!body.is_flexible()) return nullptr;
  const auto twin = std::find_if(known.begin(), known.end(), [&](const auto& other) {
    return other != nullptr && other->fits(*body.flexible);
  });
  try {
    return std::make_unique<BodyStepOperator>(
        *body.flexible, scheme, twin == known.end() ? nullptr : twin->get(), exchange);
  } catch (const NumericalError& error) {
    throw NumericalError(
        fmt::format("body \"{}\": {}; a mesh far finer than its sections also comes to this: use "
                    "fewer elements",
                    body.name, error.what()));
  }
}

/// @throws NumericalError naming the body whose motion is no longer a number
void refuse_infinite(const model::Model& model, const model::State& state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    const bool is_finite = s.frame.X_WB.p.allFinite() && s.frame.X_WB.q.coeffs().allFinite() &&
                           s.frame.v.allFinite() && s.frame.w.allFinite() && s.v_dot.allFinite() &&
                           s.w_dot.allFinite() && s.d.allFinite() && s.d_dot.allFinite() &&
                           s.d_ddot.allFinite();
    if (is_finite) continue;
    throw StepFailure(fmt::format(
        "the motion of body \"{}\" is no longer finite at t = {:.6g} s; a load, a velocity or a "
        "deformation has grown beyond any sense: check their units, or use a smaller step",
        model.bodies[b].name, state.t));
  }
}

}  // namespace

Stepper::Stepper(const model::Model& model, const StepSettings& settings,
                 std::vector<int> rows_in_use)
    : model_(model),
      settings_(settings),
      scheme_(settings.method, settings.step, settings.method_parameter()),
      bodies_(model.bodies.size()) {
  std::vector<const BodyStepOperator*> views;
  for (const body::Body& body : model.bodies) {
    operators_.push_back(factorised(body, scheme_, operators_, settings_.exchange));
    large_.push_back(body.is_flexible() ? std::make_unique<Large>(*operators_.back()) : nullptr);
    views.push_back(operators_.back().get());
  }
  newton_ = std::make_unique<SmallNewton>(model, scheme_, settings_, std::move(views),
                                          std::move(rows_in_use));
  gaps_.resize(bodies_.size());
  use_threads(settings_.threads);
  group_factors();
}

void Stepper::use_threads(int threads) {
  settings_.threads = threads;
  pool_ = threads > 1 ? std::make_unique<TaskPool>(threads) : nullptr;
}

Stepper::~Stepper() = default;

void Stepper::group_factors() {
  for (std::size_t b = 0; b < operators_.size(); ++b) {
    if (!operators_[b]) continue;
    num_dofs_ += model_.bodies[b].num_dofs();
    const linalg::SparseCholesky* factor = operators_[b]->shared_factor();
    if (factor == nullptr) continue;
    auto group = std::find_if(groups_.begin(), groups_.end(),
                              [&](const FactorGroup& known) { return known.factor == factor; });
    if (group == groups_.end()) {
      groups_.push_back({factor, {}, {}, {}});
      group = groups_.end() - 1;
    }
    group->bodies.push_back(b);
    group->active.reserve(group->bodies.size());
  }
}

template <class F>
void Stepper::for_bodies(F&& f) {
  const std::size_t count = bodies_.size();
  const bool is_shared = pool_ && num_dofs_ >= kSharedDofs;
  const std::size_t parts =
      is_shared ? std::min(count, static_cast<std::size_t>(kPartsPerThread * pool_->threads())) : 1;
  run_tasks(pool_.get(), static_cast<int>(parts), [&](int part) {
    const auto k = static_cast<std::size_t>(part);
    for (std::size_t b = count * k / parts; b < count * (k + 1) / parts; ++b) f(b);
  });
}

void Stepper::start_bodies(const model::State& state) {
  for_bodies([&](std::size_t b) {
    const model::BodyState& s = state.bodies[b];
    bodies_[b].start(s, operators_[b].get(), scheme_);
    if (!large_[b]) return;
    Large& large = *large_[b];
    scheme_.history(s.d_dot, s.d_ddot, s.d_alg, large.history);
    if (!s.terms.are_lagged()) {
      large.used = large.evaluated = {};
    } else if (state.history > 0) {
      dynamics::extrapolate(s, state.history, scheme_.evaluation_time(state.t), large.used);
    } else {
      dynamics::evaluate_coupling(model_.bodies[b], s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w,
                                  s.w_dot, large.used);
    }
    large.load_changed = true;
    bodies_[b].quadratic = large.used.moments;
  });
}

bool Stepper::free_responses(const model::State& state, bool first_round) {
  const auto is_active = [&](std::size_t b) {
    return large_[b] && (first_round || large_[b]->load_changed);
  };
  for_bodies([&](std::size_t b) {
    if (!is_active(b)) return;
    BodyStepOperator& op = *operators_[b];
    Large& large = *large_[b];
    op.form_right_side(state.bodies[b], large.history, large.used.load, large.free);
    if (op.shared_factor() == nullptr) op.solve_right_side(large.free);
  });
  for (FactorGroup& group : groups_) {
    group.active.clear();
    std::copy_if(group.bodies.begin(), group.bodies.end(), std::back_inserter(group.active),
                 is_active);
  }
  // One factor is shared between threads by its subtrees, several one by one; those that wait for
  // other simulations must not wait inside of tasks.
  TaskPool* across = settings_.exchange == nullptr ? pool_.get() : nullptr;
  run_tasks(across, static_cast<int>(groups_.size()), [&](int g) {
    groups_[static_cast<std::size_t>(g)].solve(large_, pool_.get(), settings_.exchange);
  });
  for_bodies([&](std::size_t b) {
    if (!is_active(b)) return;
    Large& large = *large_[b];
    operators_[b]->finish_response(state.bodies[b], large.history, large.free);
    bodies_[b].y_free.noalias() = operators_[b]->N() * large.free;
  });
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (is_active(b)) return true;
  }
  return false;
}

void Stepper::complete(const model::State& state) {
  for_bodies([&](std::size_t b) {
    if (!large_[b]) return;
    Large& large = *large_[b];
    const BodyStep& step = bodies_[b];
    large.d_end = large.free;
    operators_[b]->complete(step.load, step.correction_load, large.d_end);
    large.increment = large.d_end - state.bodies[b].d;
    if (!step.correction_load.isZero(0.0)) {
      operators_[b]->subtract_correction(step.correction_load, large.increment);
    }
  });
}

Stepper::CouplingGap Stepper::coupling_gap(const model::State& state, std::size_t b) {
  const body::Body& body = model_.bodies[b];
  const BodyStep& step = bodies_[b];
  Large& large = *large_[b];
  const Vector6 rate = scheme_.mean_rate * step.u + step.frame.mean_velocity;
  const Vector6 acceleration = step.frame_acceleration(scheme_);
  const Vector3d w = rate.head<3>();
  const Vector3d w_dot = acceleration.head<3>();
  // The correction belongs to the evaluated position where the method ends there.
  if (scheme_.weight == 1.0) {
    large.d_e = large.d_end;
  } else {
    large.d_e = state.bodies[b].d + scheme_.weight * large.increment;
  }
  if (scheme_.has_offset()) large.d_e += large.history.offset;
  large.rate_e = scheme_.mean_rate * large.increment + large.history.mean_velocity;
  if (!large.has_rates) large.rate_e.setZero();
  large.evaluate_acceleration(scheme_);
  dynamics::evaluate_coupling(body, step.terms, large.d_e, large.rate_e, large.acceleration_e, w,
                              w_dot, large.evaluated);
  large.evaluated.t = scheme_.evaluation_time(state.t);

  CouplingGap gap;
  double load_change = 0;
  if (step.terms.have_load()) {
    large.undeformed = large.evaluated.load;
    large.undeformed.noalias() += body.flexible->invariants.centrifugal_patterns() *
                                  dynamics::centrifugal_weights(step.terms, w);
    large.difference = large.evaluated.load - large.used.load;
    // In the norm of K̂ ≈ s M the inertia loads of a turn with the rotary inertia J are √(J/s).
    const double turn = std::sqrt(body.J0.norm() / scheme_.mass) * (w_dot.norm() + w.squaredNorm());
    const double load_size = std::max(large.norm(large.undeformed), kLeastShare * turn);
    if (load_size != 0.0) load_change = large.norm(large.difference) / load_size;
    gap.motion = scheme_.force * large.moved_by(large.difference) / model_.length;
  }
  const Vector3d frame_change =
      (dynamics::frame_inertia(body, large.evaluated.moments, w, w_dot, Vector3d::Zero()) -
       dynamics::frame_inertia(body, large.used.moments, w, w_dot, Vector3d::Zero()))
          .head<3>();
  const double frame_size = body.J0.norm() * (w_dot.norm() + w.squaredNorm());
  const double frame_relative = frame_size > 0.0 ? frame_change.norm() / frame_size : 0.0;
  gap.motion = std::max(
      gap.motion, scheme_.force * (step.compliance.topLeftCorner<3, 3>() * frame_change).norm());
  large.load_changed = load_change > settings_.outer_tolerance;
  gap.is_settled = !large.load_changed && !(frame_relative > settings_.outer_tolerance);
  gap.change = std::max(load_change, frame_relative);
  return gap;
}

bool Stepper::coupling_settled(const model::State& state, StepReport& report) {
  for_bodies([&](std::size_t b) {
    const bool matters = large_[b] && bodies_[b].terms.are_lagged();
    gaps_[b] = matters ? coupling_gap(state, b) : CouplingGap{};
  });
  bool settled = true;
  report.coupling_change = 0;
  coupling_motion_ = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!large_[b] || !bodies_[b].terms.are_lagged()) continue;
    const CouplingGap& gap = gaps_[b];
    settled = settled && gap.is_settled;
    coupling_motion_ = std::max(coupling_motion_, gap.motion);
    if (!(gap.change <= report.coupling_change)) least_settled_ = b;
    report.coupling_change = std::max(report.coupling_change, gap.change);
  }
  return settled;
}

void Stepper::form_next_state(const model::State& state) {
  model::State& next = next_;
  next.t = state.t + scheme_.h;
  next.lambda = lambda_;
  next.lambda_time = scheme_.evaluation_time(state.t);
  next.last_step = scheme_.h;
  next.history = std::min(3, state.history + 1);
  next.bodies.resize(bodies_.size());
  for_bodies([&](std::size_t b) {
    const model::BodyState& old = state.bodies[b];
    model::BodyState& s = next.bodies[b];
    s.frame = newton_->motions_at_end()[b].frame;
    const Vector6 acceleration = bodies_[b].frame_acceleration(scheme_);
    s.w_dot = scheme_.carried_acceleration<Vector3d>(old.w_dot, acceleration.head<3>());
    s.v_dot = scheme_.carried_acceleration<Vector3d>(old.v_dot, acceleration.tail<3>());
    s.w_alg = scheme_.algorithmic(old.w_dot, old.w_alg, s.w_dot);
    s.v_alg = scheme_.algorithmic(old.v_dot, old.v_alg, s.v_dot);
    s.terms = old.terms;
    if (!large_[b]) return;
    Large& large = *large_[b];
    large.evaluate_acceleration(scheme_);
    s.d = large.d_end;
    s.d_dot = scheme_.end_rate * large.increment + large.history.velocity;
    if (!large.has_rates) s.d_dot.setZero();
    scheme_.carried_acceleration(old.d_ddot, large.acceleration_e, s.d_ddot);
    scheme_.algorithmic(old.d_ddot, old.d_alg, s.d_ddot, s.d_alg);
    s.coupling = large.evaluated;
    s.coupling_before = old.coupling;
    s.coupling_earlier = old.coupling_before;
  });
}

void Stepper::take_over_coupling() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!large_[b] || !bodies_[b].terms.are_lagged()) continue;
    if (large_[b]->load_changed) {
      large_[b]->used = large_[b]->evaluated;
    } else {
      large_[b]->used.moments = large_[b]->evaluated.moments;
    }
    bodies_[b].quadratic = large_[b]->used.moments;
  }
}

void Stepper::compute_round(const model::State& state, bool is_first, StepReport& report) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto start = Clock::now();
  if (free_responses(state, is_first)) ++report.large_solve_rounds;
  const auto solved = Clock::now();
  if (is_first) newton_->prepare(bodies_, state.t);
  newton_->iterate(bodies_, state.t, lambda_, report);
  const auto iterated = Clock::now();
  complete(state);
  seconds_.large_solves += seconds(solved - start);
  seconds_.newton += seconds(iterated - solved);
  seconds_.completion += seconds(Clock::now() - iterated);
}

StepReport Stepper::step(const model::State& before, model::State& after) {
  if (!must_rescale(before, scheme_)) return take_step(before, after);
  model::State rescaled = before;
  rescale_algorithmic(rescaled, scheme_);
  return take_step(rescaled, after);
}

StepReport Stepper::take_step(const model::State& state, model::State& end) {
  StepReport report;
  lambda_ = state.lambda;
  start_bodies(state);
  double last_change = HUGE_VAL;
  for (int round = 0;; ++round) {
    compute_round(state, round == 0, report);
    if (coupling_settled(state, report)) break;
    const double change = report.coupling_change;
    const bool is_rounding = change <= kCouplingRounding || coupling_motion_ <= kPositionRounding;
    if (is_rounding && change > 0.5 * last_change) break;
    const bool is_second = report.large_solve_rounds >= 2 && !settings_.iterate_coupling;
    const bool is_small = coupling_motion_ <= kSecondSolveMotion && change <= 0.5 * last_change;
    if (is_second && (change <= kSecondSolve || is_small)) break;
    last_change = change;
    if (round + 1 >= settings_.max_outer || !std::isfinite(change)) {
      throw StepFailure(fmt::format(
          "step at t = {:.6g} s failed: the inertial coupling of body \"{}\" does not settle "
          "(relative change {:.3g} after {} solves); the deformation is too large for linear "
          "elasticity in one frame, or the step {:.3g} s is too long",
          state.t, model_.bodies[least_settled_].name, change, round + 1, scheme_.h));
    }
    take_over_coupling();
  }
  form_next_state(state);
  refuse_infinite(model_, next_);
  stepped_to_ = next_.t;
  has_stepped_ = true;
  std::swap(end, next_);  // what was `end` lends its memory to the next step
  return report;
}

double Stepper::factor_entries() const {
  double sum = 0;
  for (const auto& op : operators_) {
    if (op) sum += op->factor_entries();
  }
  return sum;
}

double Stepper::factor_bytes() const {
  double sum = 0;
  for (const auto& op : operators_) {
    if (op) sum += op->factor_bytes();
  }
  return sum;
}

double Stepper::neglected(std::size_t body, const model::State& state,
                          const body::CouplingTerms& kept) const {
  const bool is_balanced = has_stepped_ && scheme_.weight == 1.0 &&
                           std::abs(state.t - stepped_to_) <= kSameInstant * scheme_.h &&
                           kept == bodies_[body].terms && !operators_[body]->is_quasi_static();
  return neglected_share(model_.bodies[body], *operators_[body], state.bodies[body], kept,
                         is_balanced ? &bodies_[body].load : nullptr);
}

double Stepper::lowest_frequency(std::size_t body) {
  return stepping::lowest_frequency(*model_.bodies[body].flexible, *operators_[body]);
}

SolveCounts Stepper::counts(std::size_t body) const {
  if (!operators_[body]) return {};
  const BodyStepOperator& op = *operators_[body];
  return {op.factorisations(), op.solves(), op.setup_solves()};
}

}  // namespace buckens::stepping
