// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/stepper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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
}  // namespace

/// The n-sized share of one flexible body in a step.
struct Stepper::Large {
  explicit Large(const BodyStepOperator& op)
      : inverse_diagonal(op.K_hat().diagonal().cwiseInverse()) {}

  History<Vector> history;
  model::Coupling used;       // what the step was computed with
  model::Coupling evaluated;  // what its result gives
  Vector free;                // end value without interface loads
  Vector d_end;               // end value
  Vector increment;           // Δ: end value without correction, minus the start
  Vector inverse_diagonal;    // of K̂: measures loads
  bool load_changed = true;

  Vector rate(const Scheme& scheme) const { return scheme.end_rate * increment + history.velocity; }
  Vector acceleration(const Scheme& scheme) const {
    return scheme.acceleration_rate * increment + history.acceleration;
  }
  double norm(const Vector& load) const {
    return std::sqrt(load.cwiseAbs2().dot(inverse_diagonal));
  }
  /// Largest displacement (before the factor c) by a load, estimated from the diagonal of K̂.
  double moved_by(const Vector& load) const {
    return load.cwiseProduct(inverse_diagonal).cwiseAbs().maxCoeff();
  }
};

namespace {

/// @param known operators of other bodies, one of which may have the factor already
std::unique_ptr<BodyStepOperator> factorised(
    const body::Body& body, const Scheme& scheme,
    const std::vector<std::unique_ptr<BodyStepOperator>>& known) {
  if (!body.is_flexible()) return nullptr;
  const auto twin = std::find_if(known.begin(), known.end(), [&](const auto& other) {
    return other != nullptr && other->fits(*body.flexible);
  });
  try {
    return std::make_unique<BodyStepOperator>(*body.flexible, scheme,
                                              twin == known.end() ? nullptr : twin->get());
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
    operators_.push_back(factorised(body, scheme_, operators_));
    large_.push_back(body.is_flexible() ? std::make_unique<Large>(*operators_.back()) : nullptr);
    views.push_back(operators_.back().get());
  }
  newton_ = std::make_unique<SmallNewton>(model, scheme_, settings_, std::move(views),
                                          std::move(rows_in_use));
}

Stepper::~Stepper() = default;

void Stepper::start_bodies(const model::State& state) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    const body::Body& body = model_.bodies[b];
    bodies_[b].start(s, operators_[b].get(), scheme_);
    if (!large_[b]) continue;
    Large& large = *large_[b];
    large.history = scheme_.history(s.d_dot, s.d_ddot, s.d_alg);
    if (!s.terms.are_lagged()) {
      large.used = large.evaluated = {};
    } else if (state.history > 0) {
      large.used = dynamics::extrapolate(s, state.history, scheme_.evaluation_time(state.t));
    } else {
      large.used =
          dynamics::evaluate_coupling(body, s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w, s.w_dot);
    }
    large.load_changed = true;
    bodies_[b].quadratic = large.used.moments;
  }
}

bool Stepper::free_responses(const model::State& state, bool first_round) {
  bool any = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!large_[b] || !(first_round || large_[b]->load_changed)) continue;
    Large& large = *large_[b];
    operators_[b]->free_response(state.bodies[b], large.history, large.used.load, large.free);
    bodies_[b].y_free = operators_[b]->N() * large.free;
    any = true;
  }
  return any;
}

void Stepper::complete(const model::State& state) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!large_[b]) continue;
    Large& large = *large_[b];
    const BodyStep& step = bodies_[b];
    large.d_end = large.free;
    operators_[b]->complete(step.load, step.correction_load, large.d_end);
    large.increment = large.d_end - state.bodies[b].d;
    if (!step.correction_load.isZero(0.0)) {
      large.increment -= operators_[b]->correction(step.correction_load);
    }
  }
}

bool Stepper::coupling_settled(const model::State& state, StepReport& report) {
  bool settled = true;
  report.coupling_change = 0;
  coupling_motion_ = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const BodyStep& step = bodies_[b];
    if (!large_[b] || !step.terms.are_lagged()) continue;
    Large& large = *large_[b];
    const Vector6 rate = scheme_.mean_rate * step.u + step.frame.mean_velocity;
    const Vector6 acceleration = step.frame_acceleration(scheme_);
    const Vector3d w = rate.head<3>();
    const Vector3d w_dot = acceleration.head<3>();
    // The correction belongs to the evaluated position where the method ends there.
    Vector d_e = scheme_.weight == 1.0
                     ? large.d_end
                     : Vector(state.bodies[b].d + scheme_.weight * large.increment);
    if (scheme_.has_offset()) d_e += large.history.offset;
    const Vector d_dot = scheme_.mean_rate * large.increment + large.history.mean_velocity;
    large.evaluated = dynamics::evaluate_coupling(body, step.terms, d_e, d_dot,
                                                  large.acceleration(scheme_), w, w_dot);
    large.evaluated.t = scheme_.evaluation_time(state.t);

    double load_change = 0;
    double moved = 0;
    if (step.terms.have_load()) {
      const Vector undeformed = body.flexible->invariants.centrifugal_patterns() *
                                dynamics::centrifugal_weights(step.terms, w);
      const Vector difference = large.evaluated.load - large.used.load;
      const double load_size = large.norm(large.evaluated.load + undeformed);
      if (load_size != 0.0) load_change = large.norm(difference) / load_size;
      moved = scheme_.force * large.moved_by(difference) / model_.length;
    }
    const Vector3d frame_change =
        (dynamics::frame_inertia(body, large.evaluated.moments, w, w_dot, Vector3d::Zero()) -
         dynamics::frame_inertia(body, large.used.moments, w, w_dot, Vector3d::Zero()))
            .head<3>();
    const double frame_size = body.J0.norm() * (w_dot.norm() + w.squaredNorm());
    const double frame_relative = frame_size > 0.0 ? frame_change.norm() / frame_size : 0.0;
    const double turned =
        scheme_.force * (step.compliance.topLeftCorner<3, 3>() * frame_change).norm();
    coupling_motion_ = std::max({coupling_motion_, moved, turned});
    large.load_changed = load_change > settings_.outer_tolerance;
    if (large.load_changed || frame_relative > settings_.outer_tolerance) settled = false;
    const double change = std::max(load_change, frame_relative);
    if (!(change <= report.coupling_change)) least_settled_ = b;
    report.coupling_change = std::max(report.coupling_change, change);
  }
  return settled;
}

model::State Stepper::next_state(const model::State& state, const Vector& lambda) const {
  model::State next;
  next.t = state.t + scheme_.h;
  next.lambda = lambda;
  next.lambda_time = scheme_.evaluation_time(state.t);
  next.last_step = scheme_.h;
  next.history = std::min(3, state.history + 1);
  next.bodies.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const model::BodyState& old = state.bodies[b];
    model::BodyState& s = next.bodies[b];
    s.frame = newton_->motions_at_end()[b].frame;
    const Vector6 acceleration = bodies_[b].frame_acceleration(scheme_);
    s.w_dot = scheme_.carried_acceleration<Vector3d>(old.w_dot, acceleration.head<3>());
    s.v_dot = scheme_.carried_acceleration<Vector3d>(old.v_dot, acceleration.tail<3>());
    s.w_alg = scheme_.algorithmic(old.w_dot, old.w_alg, s.w_dot);
    s.v_alg = scheme_.algorithmic(old.v_dot, old.v_alg, s.v_dot);
    s.terms = old.terms;
    if (!large_[b]) continue;
    s.d = large_[b]->d_end;
    s.d_dot = large_[b]->rate(scheme_);
    s.d_ddot = scheme_.carried_acceleration(old.d_ddot, large_[b]->acceleration(scheme_));
    s.d_alg = scheme_.algorithmic(old.d_ddot, old.d_alg, s.d_ddot);
    s.coupling = large_[b]->evaluated;
    s.coupling_before = old.coupling;
    s.coupling_earlier = old.coupling_before;
  }
  return next;
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

void Stepper::compute_round(const model::State& state, bool is_first, Vector& lambda,
                            StepReport& report) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto start = Clock::now();
  if (free_responses(state, is_first)) ++report.large_solve_rounds;
  const auto solved = Clock::now();
  if (is_first) newton_->prepare(bodies_, state.t);
  newton_->iterate(bodies_, state.t, lambda, report);
  const auto iterated = Clock::now();
  complete(state);
  seconds_.large_solves += seconds(solved - start);
  seconds_.newton += seconds(iterated - solved);
  seconds_.completion += seconds(Clock::now() - iterated);
}

StepReport Stepper::step(model::State& state) {
  if (!must_rescale(state, scheme_)) return take_step(state, state);
  model::State rescaled = state;
  rescale_algorithmic(rescaled, scheme_);
  return take_step(rescaled, state);
}

StepReport Stepper::take_step(const model::State& state, model::State& end) {
  StepReport report;
  Vector lambda = state.lambda;
  start_bodies(state);
  double before = HUGE_VAL;
  for (int round = 0;; ++round) {
    compute_round(state, round == 0, lambda, report);
    if (coupling_settled(state, report)) break;
    const double change = report.coupling_change;
    const bool is_rounding = change <= kCouplingRounding || coupling_motion_ <= kPositionRounding;
    if (is_rounding && change > 0.5 * before) break;
    const bool is_second = report.large_solve_rounds >= 2 && !settings_.iterate_coupling;
    const bool is_small = coupling_motion_ <= kSecondSolveMotion && change <= 0.5 * before;
    if (is_second && (change <= kSecondSolve || is_small)) break;
    before = change;
    if (round + 1 >= settings_.max_outer || !std::isfinite(change)) {
      throw StepFailure(fmt::format(
          "step at t = {:.6g} s failed: the inertial coupling of body \"{}\" does not settle "
          "(relative change {:.3g} after {} solves); the deformation is too large for linear "
          "elasticity in one frame, or the step {:.3g} s is too long",
          state.t, model_.bodies[least_settled_].name, change, round + 1, scheme_.h));
    }
    take_over_coupling();
  }
  model::State next = next_state(state, lambda);
  refuse_infinite(model_, next);
  end = std::move(next);
  return report;
}

double Stepper::factor_entries() const {
  double sum = 0;
  for (const auto& op : operators_) {
    if (op) sum += op->factor_entries();
  }
  return sum;
}

double Stepper::neglected(std::size_t body, const model::State& state,
                          const body::CouplingTerms& kept) const {
  return neglected_share(model_.bodies[body], *operators_[body], state.bodies[body], kept);
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
