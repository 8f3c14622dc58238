// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/stepper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/timed_phase.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/stepping/change_of_step.h"
#include "buckens/stepping/lowest_frequency.h"
#include "buckens/stepping/step_failure.h"
#include "buckens/stepping/strand/step.h"

namespace buckens::stepping {

using Eigen::Vector3d;

namespace {

// Ends of steps are counted elsewhere, not summed.
constexpr double kSameInstant = 1e-6;
// With fewer variables in all bodies together, waking a thread does not pay.
constexpr Eigen::Index kSharedDofs = 2000;
constexpr int kPartsPerThread = 4;

using Operators = std::vector<std::shared_ptr<BodyStepOperator>>;

/// @param known operators of other bodies, one of which may be that of this body or have its factor
std::shared_ptr<BodyStepOperator> factorised(const body::Body& body, const Scheme& scheme,
                                             const Operators& known, const StepSettings& settings) {
  if (!body.is_flexible()) return nullptr;
  const auto same = std::find_if(known.begin(), known.end(), [&](const auto& other) {
    return other != nullptr && other->serves(*body.flexible);
  });
  if (same != known.end()) return *same;
  const auto twin = std::find_if(known.begin(), known.end(), [&](const auto& other) {
    return other != nullptr && other->fits(*body.flexible);
  });
  try {
    const BodyStepOperator* first = twin == known.end() ? nullptr : twin->get();
    return std::make_shared<BodyStepOperator>(
        *body.flexible, scheme,
        FactorSource{first, settings.exchange, settings.make_factor, settings.vectors});
  } catch (const NumericalError& error) {
    throw NumericalError(fmt::format("body \"{}\": {}", body.name, error.what()));
  }
}

/// @throws StepFailure naming the body whose motion is no longer a number
[[noreturn]] void fail_infinite(const body::Body& body, double t) {
  throw StepFailure(
      fmt::format("the motion of body \"{}\" has diverged at t = {:.6g} s; a load, a velocity or a "
                  "deformation has diverged: check units, or use a smaller step",
                  body.name, t));
}

bool is_frame_finite(const model::BodyState& s) {
  return s.frame.X_WB.p.allFinite() && s.frame.X_WB.q.coeffs().allFinite() &&
         s.frame.v.allFinite() && s.frame.w.allFinite() && s.v_dot.allFinite() &&
         s.w_dot.allFinite();
}

}  // namespace

Stepper::Stepper(const model::Model& model, const StepSettings& settings,
                 std::vector<int> rows_in_use)
    : model_(model),
      settings_(settings),
      scheme_(settings.method, settings.step, settings.method_parameter()),
      forecast_(scheme_, model.length),
      forecasts_(!model.may_have_rigid_rows()),
      friction_(model, scheme_),
      bodies_(model.bodies.size()) {
  for (const body::Body& body : model.bodies) {
    auto op = factorised(body, scheme_, operators_, settings_);
    has_own_operator_.push_back(
        op != nullptr && std::find(operators_.begin(), operators_.end(), op) == operators_.end());
    operators_.push_back(std::move(op));
    flexible_.push_back(
        body.is_flexible() ? std::make_unique<FlexibleStep>(body, *operators_.back()) : nullptr);
  }
  make_iteration(std::move(rows_in_use));
  StrandMechanism::Operators small;
  for (const auto& op : operators_) small.push_back(op.get());
  strand_ = StrandStep::make(model, settings_, scheme_, small);
  gaps_.resize(bodies_.size());
  use_threads(settings_.threads);
  group_factors();
}

void Stepper::make_iteration(std::vector<int> rows_in_use) {
  std::vector<const BodyAnswer*> views;
  for (const auto& op : operators_) views.push_back(op.get());
  impacts_ = std::make_unique<Impacts>(model_, scheme_, views);
  newton_ = std::make_unique<SmallNewton>(model_, scheme_, settings_, std::move(views),
                                          std::move(rows_in_use));
  pairs_.clear();
  for (const model::PairLoads& loads : model_.pair_loads) pairs_.push_back(loads.pair);
}

void Stepper::follow_pairs() {
  const bool are_same =
      std::equal(pairs_.begin(), pairs_.end(), model_.pair_loads.begin(), model_.pair_loads.end(),
                 [](const model::NearPair& own, const auto& loads) { return own == loads.pair; });
  if (are_same) return;
  base::SavedValues saved;
  newton_->visit_saved(base::SaveVisit::saving(saved));
  make_iteration(newton_->rows_in_use());
  newton_->visit_saved(base::SaveVisit::restoring(saved));
}

void Stepper::accept_last_stands(bool accepts) {
  follow_pairs();
  newton_->accept_last_stands(accepts);
}

void Stepper::decide_first(bool decides) {
  follow_pairs();
  newton_->decide_first(decides);
}

void Stepper::use_threads(int threads) {
  settings_.threads = threads;
  if (settings_.pool != nullptr && settings_.pool->threads() == threads) {
    own_pool_ = nullptr;
    pool_ = settings_.pool;
    return;
  }
  own_pool_ = threads > 1 ? std::make_unique<TaskPool>(threads) : nullptr;
  pool_ = own_pool_.get();
}

Stepper::~Stepper() = default;

void Stepper::group_factors() {
  for (std::size_t b = 0; b < operators_.size(); ++b) {
    if (!operators_[b]) continue;
    num_dofs_ += model_.bodies[b].num_dofs();
    const linalg::Factor* factor = operators_[b]->shared_factor();
    if (factor == nullptr) continue;
    auto group = std::find_if(groups_.begin(), groups_.end(),
                              [&](const FactorGroup& known) { return &known.factor() == factor; });
    if (group == groups_.end()) {
      groups_.emplace_back(*factor, flexible_[b]->coupling.inverse_diagonal(), settings_);
      group = groups_.end() - 1;
    }
    group->add(*flexible_[b], b);
  }
  for (const auto& body : flexible_) {
    if (body) body->coupling.let_go();
  }
}

template <class F>
void Stepper::for_bodies(F&& f) {
  const std::size_t count = bodies_.size();
  // Bodies that meet those of other simulations must not wait inside of tasks.
  const bool is_shared = pool_ && num_dofs_ >= kSharedDofs && settings_.exchange == nullptr;
  const std::size_t parts =
      is_shared ? std::min(count, static_cast<std::size_t>(kPartsPerThread * pool_->threads())) : 1;
  run_tasks(pool_, static_cast<int>(parts), [&](int part) {
    const auto k = static_cast<std::size_t>(part);
    for (std::size_t b = count * k / parts; b < count * (k + 1) / parts; ++b) f(b);
  });
}

void Stepper::start_bodies(const model::State& state) {
  for_bodies([&](std::size_t b) {
    const model::BodyState& s = state.bodies[b];
    if (flexible_[b]) flexible_[b]->coupling.start(s, state.history, state.t, pool_);
    // Last: the right-hand side reads the same vectors of the mesh next.
    bodies_[b].start(s, operators_[b].get(), scheme_, pool_);
    if (flexible_[b]) bodies_[b].quadratic = flexible_[b]->coupling.used().moments;
  });
}

Stepper::Answers Stepper::free_responses(const model::State& state, int round) {
  const bool first_round = round == 0;
  const auto is_active = [&](std::size_t b) {
    return flexible_[b] && (first_round || flexible_[b]->coupling.load_changed());
  };
  long solves = 0;
  bool any_active = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!is_active(b)) continue;
    any_active = true;
    solves -= flexible_[b]->solves;
  }
  if (!any_active) return Answers::none_asked;
  for_bodies([&](std::size_t b) {
    if (!is_active(b)) return;
    FlexibleStep& body = *flexible_[b];
    if (first_round) {
      body.large.form_right_side(state.bodies[b], body.coupling.used().load, pool_);
    } else {
      body.large.form_right_side_of_change(body.coupling.load_before(), body.coupling.used().load,
                                           pool_);
    }
    BodyStepOperator& op = *operators_[b];
    if (op.shared_factor() != nullptr) return;
    op.solve_right_side(body.large.side());
    ++body.solves;
  });
  // One factor is shared between threads by its subtrees, several one by one; those that wait for
  // other simulations must not wait inside of tasks.
  TaskPool* across = settings_.exchange == nullptr ? pool_ : nullptr;
  run_tasks(across, static_cast<int>(groups_.size()), [&](int g) {
    FactorGroup& group = groups_[static_cast<std::size_t>(g)];
    first_round ? group.solve_loads(state, pool_) : group.answer_changes(state, round == 1, pool_);
  });
  for_bodies([&](std::size_t b) {
    if (!is_active(b)) return;
    flexible_[b]->large.take_solution(state.bodies[b], bodies_[b].y_free, pool_);
  });
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (is_active(b)) solves += flexible_[b]->solves;
  }
  return solves > 0 ? Answers::solved : Answers::all_recycled;
}

void Stepper::recall_solves(const model::State& before) {
  bool goes_on = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flexible_[b]) continue;
    const body::FrameMotion& end = flexible_[b]->frame_at_end;
    const body::FrameMotion& start = before.bodies[b].frame;
    goes_on = goes_on && start.X_WB.p == end.X_WB.p &&
              start.X_WB.q.coeffs() == end.X_WB.q.coeffs() && start.v == end.v && start.w == end.w;
  }
  for (FactorGroup& group : groups_) {
    if (!goes_on) {
      group.forget();
    } else if (has_lesson_) {
      group.learn(pool_);
    }
  }
  has_lesson_ = false;
}

void Stepper::finish_lesson(const model::State& end) {
  has_lesson_ = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (flexible_[b]) flexible_[b]->frame_at_end = end.bodies[b].frame;
  }
}

void Stepper::complete(const model::State& state) {
  for_bodies([&](std::size_t b) {
    if (!flexible_[b]) return;
    flexible_[b]->large.complete(state.bodies[b], bodies_[b].load, bodies_[b].correction_load,
                                 next_.bodies[b], pool_);
  });
}

CouplingRounds::Gap Stepper::compare_coupling(const model::State& state) {
  for_bodies([&](std::size_t b) {
    const bool matters = flexible_[b] && bodies_[b].terms.are_lagged();
    gaps_[b] = {};
    if (!matters) return;
    gaps_[b] = flexible_[b]->coupling.evaluate(bodies_[b], flexible_[b]->large, next_.bodies[b],
                                               state.t, settings_, model_.length, pool_);
  });
  CouplingRounds::Gap out;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flexible_[b] || !bodies_[b].terms.are_lagged()) continue;
    const LaggedCoupling::Gap& gap = gaps_[b];
    out.is_settled = out.is_settled && gap.is_settled();
    out.motion = std::max(out.motion, gap.motion);
    if (!(gap.change <= out.change)) least_settled_ = b;
    out.change = std::max(out.change, gap.change);
  }
  return out;
}

void Stepper::form_next_instant(const model::State& state) {
  model::State& next = next_;
  next.t = state.t + scheme_.h;
  next.lambda_time = scheme_.evaluation_time(state.t);
  next.last_step = scheme_.h;
  next.history = std::min(3, state.history + 1);
  next.inputs = state.inputs;
  note_past(state, next);
}

void Stepper::form_next_state(const model::State& state) {
  model::State& next = next_;
  form_next_instant(state);
  next.lambda = lambda_;
  dynamics::advance_memory(model_, newton_->motions_at_end(), next.t, newton_->around(),
                           next.memory, newton_->law_ends());
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
    if (!flexible_[b]) return;
    // complete() formed the nodal variables; the old buffers are reused in the next step.
    model::Coupling& evaluated = flexible_[b]->coupling.evaluated();
    std::swap(s.coupling, evaluated);
    // The memory that no state shares from here on is that of the earliest load.
    evaluated.load.swap(s.coupling_earlier.load);
    s.coupling_before = old.coupling;
    s.coupling_earlier = old.coupling_before;
  });
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const bool is_finite =
        is_frame_finite(next.bodies[b]) && (!flexible_[b] || flexible_[b]->large.is_finite());
    if (!is_finite) fail_infinite(model_.bodies[b], next.t);
  }
}

void Stepper::take_friction(double t, StepReport& report) {
  if (friction_.empty()) return;
  dynamics::Circumstances around = newton_->around();
  if (!newton_->forces().signals.values.empty()) around.signals = &newton_->forces().signals.values;
  friction_.take({scheme_.evaluation_time(t), newton_->at_evaluation()},
                 {t + scheme_.h, newton_->motions_at_end()}, around, newton_->law_ends());
  report.friction = &friction_;
}

void Stepper::take_over_coupling() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flexible_[b] || !bodies_[b].terms.are_lagged()) continue;
    flexible_[b]->coupling.take_over();
    bodies_[b].quadratic = flexible_[b]->coupling.used().moments;
  }
}

void Stepper::compute_round(const model::State& state, int round, StepReport& report) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto start = Clock::now();
  switch (free_responses(state, round)) {
    case Answers::solved:
      ++report.large_solve_rounds;
      break;
    case Answers::all_recycled:
      ++report.recycled_rounds;
      break;
    case Answers::none_asked:
      break;
  }
  const auto solved = Clock::now();
  if (round == 0) {
    const bool is_foretold = forecasts_ && forecast_.foretells(state);
    newton_->prepare(bodies_, state.t, !is_foretold);
    // After it: matrix and directions belong to where the last accelerations lead.
    if (is_foretold) forecast_.apply(state, bodies_, lambda_);
    newton_->iterate(bodies_, state.t, lambda_, report, state.had_rounds);
  } else {
    newton_->iterate_on(bodies_, state.t, lambda_, report);
  }
  const auto iterated = Clock::now();
  complete(state);
  seconds_.large_solves += seconds(solved - start);
  seconds_.newton += seconds(iterated - solved);
  seconds_.completion += seconds(Clock::now() - iterated);
}

StepReport Stepper::step(const model::State& before, model::State& after) {
  try {
    if (!must_rescale(before, scheme_)) return take_step(before, after);
    model::State rescaled = before;
    rescale_algorithmic(rescaled, scheme_);
    return take_step(rescaled, after);
  } catch (const StepTooLong& error) {
    throw StepFailure(fmt::format("step at t = {:.6g} s failed: {}", before.t, error.text()));
  }
}

StepReport Stepper::take_step(const model::State& state, model::State& end) {
  StepReport report;
  recall_solves(state);
  follow_pairs();
  if (!take_strand_step(state, report)) report = take_general_step(state);
  stepped_to_ = next_.t;
  finish_lesson(next_);
  std::swap(end, next_);  // the buffers of `end` are reused in the next step
  return report;
}

bool Stepper::take_strand_step(const model::State& state, StepReport& report) {
  if (!strand_ || !strand_->takes(state, newton_->rows_in_use())) return false;
  const auto start = std::chrono::steady_clock::now();
  if (!strand_->step(state, next_, report)) return false;
  form_next_instant(state);
  dynamics::advance_memory(model_, strand_->motions_at_end(), next_.t,
                           {&state.inputs, &state.memory, &next_.lambda}, next_.memory);
  has_stepped_ = false;  // loads on bodies are not kept
  seconds_.newton +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return true;
}

StepReport Stepper::take_general_step(const model::State& state) {
  StepReport report;
  lambda_ = state.lambda;
  next_.bodies.resize(bodies_.size());
  newton_->use({&state.inputs, &state.memory, &lambda_});
  start_bodies(state);
  if (impacts_->can_happen()) {
    at_start_.resize(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b].motion_at_start(at_start_[b]);
    impacts_->start(at_start_, state.t, state.memory);
  }
  CouplingRounds rounds(settings_);
  for (int round = 0;; ++round) {
    compute_round(state, round, report);
    const CouplingRounds::Gap gap = compare_coupling(state);
    report.coupling_change = gap.change;
    const auto verdict = rounds.judge(gap, report.large_solve_rounds + report.recycled_rounds);
    next_.had_rounds = round > 0;
    if (verdict == CouplingRounds::Verdict::ends) break;
    if (verdict == CouplingRounds::Verdict::fails) {
      throw StepFailure(fmt::format(
          "step at t = {:.6g} s failed: the inertial coupling of body \"{}\" does not "
          "converge (relative change {:.3g} after {} solves); the deformation is too "
          "large for linear elasticity in one frame, or the step {:.3g} s is too long",
          state.t, model_.bodies[least_settled_].name, gap.change, round + 1, scheme_.h));
    }
    take_over_coupling();
  }
  if (newton_->has_left_open()) {
    newton_->iterate_on(bodies_, state.t, lambda_, report);
    complete(state);
  }
  form_next_state(state);
  take_friction(state.t, report);
  report.must_settle = newton_->rigid_rows_changed();
  report.has_undecided_rows = newton_->has_accepted_stands();
  report.ends_have_turned = newton_->ends_have_turned();
  take_impacts(report);
  has_stepped_ = true;
  return report;
}

double Stepper::factor_entries() const {
  double sum = 0;
  for (std::size_t b = 0; b < operators_.size(); ++b) {
    if (has_own_operator_[b]) sum += operators_[b]->factor_entries();
  }
  return sum;
}

double Stepper::factor_bytes() const {
  double sum = 0;
  for (std::size_t b = 0; b < operators_.size(); ++b) {
    if (has_own_operator_[b]) sum += operators_[b]->factor_bytes();
  }
  return sum;
}

bool Stepper::has_balance(std::size_t body, const model::State& state,
                          const body::CouplingTerms& kept) const {
  return has_stepped_ && scheme_.weight == 1.0 &&
         std::abs(state.t - stepped_to_) <= kSameInstant * scheme_.h &&
         kept == bodies_[body].terms && !operators_[body]->is_quasi_static();
}

double Stepper::neglected(std::size_t body, const model::State& state,
                          const body::CouplingTerms& kept) const {
  return neglected_share(model_.bodies[body], *operators_[body], state.bodies[body], kept,
                         has_balance(body, state, kept) ? &bodies_[body].load : nullptr);
}

double Stepper::lowest_frequency(std::size_t body) {
  const base::TimedPhase phase("lowest_frequency");
  return stepping::lowest_frequency(*model_.bodies[body].flexible, *operators_[body], pool_);
}

SolveCounts Stepper::counts(std::size_t body) const {
  if (!operators_[body]) return {};
  const BodyStepOperator& op = *operators_[body];
  const FlexibleStep& step = *flexible_[body];
  const bool owns = has_own_operator_[body] != 0;
  const long solves = step.solves + (strand_ ? strand_->solves(body) : 0);
  return {owns ? op.factorisations() : 0,
          solves,
          step.recycled,
          owns ? op.setup_solves() : 0,
          step.iterations,
          step.solve_seconds,
          owns && op.iterates() ? op.factor_bytes() : 0.0};
}

std::string Stepper::why_solver(std::size_t body) const {
  return operators_[body] ? operators_[body]->why_solver() : std::string();
}

}  // namespace buckens::stepping
