// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/signals.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/drives.h"
#include "buckens/dynamics/read_motion.h"
#include "buckens/dynamics/travel.h"
#include "buckens/model/function_signal.h"

namespace buckens::dynamics {

using linalg::Vector;
using model::Signal;

namespace {

// Instants closer than this share of the last step are one.
constexpr double kSameInstant = 1e-9;
// Of a sample time: sums of steps round.
constexpr double kSampleInstant = 1e-6;
// Of differences for the tangent of states.
constexpr double kDifference = 1e-6;
constexpr int kMostIterations = 40;
// No quantity of a machine in SI units comes near it.
constexpr double kWithoutBound = 1e30;
// Changes of states, relative to the largest of them, that end the iteration; what no longer falls
// is rounding below the second.
constexpr double kSettled = 1e-14;
constexpr double kRounding = 1e-10;

/// First-order generalised-α (Jansen, Whiting, Hulbert 2000): with the rates a of the method
/// (1 − α_m) a⁺ + α_m a = (1 − α_f) ẋ⁺ + α_f ẋ,  x⁺ = x + h ((1 − γ) a + γ a⁺).
struct FirstOrderScheme {
  explicit FirstOrderScheme(double rho)
      : alpha_f(rho / (1.0 + rho)),
        alpha_m(0.5 * (3.0 * rho - 1.0) / (1.0 + rho)),
        gamma(0.5 + alpha_f - alpha_m) {}

  double share_of_rate() const { return (1.0 - alpha_f) / (1.0 - alpha_m); }
  /// a⁺ without the share of ẋ⁺.
  template <class Rate>
  void find_known(const Rate& rate, const Vector& method_rate, Vector& out) const {
    out = (alpha_f * rate - alpha_m * method_rate) / (1.0 - alpha_m);
  }

  double alpha_f, alpha_m, gamma;
};

class Evaluation {
 public:
  Evaluation(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
             const Circumstances& around, const CoordinateShift& shift, SignalValues& out)
      : model_(model), motions_(motions), t_(t), around_(around), shift_(shift), out_(out) {
    out_.values.resize(model.signals.all.size() + 1);
    out_.values[0] = t;
    around_.signals = &out_.values;
    for (const int k : model_.signals.order) {
      const Signal& signal = model_.signals.all[static_cast<std::size_t>(k)];
      if (depends_on_motion(signal)) value(k) = motion_value(signal);
    }
  }

  /// All values, and the rates of the states.
  void evaluate(const Vector& x, Vector& x_dot) {
    for (const int k : model_.signals.order) {
      const Signal& signal = model_.signals.all[static_cast<std::size_t>(k)];
      if (!depends_on_motion(signal)) value(k) = made_value(signal, x);
    }
    for (const Signal& signal : model_.signals.all) {
      if (!signal.block) continue;
      signal.block->rates(states(signal, x), signal.input.value(t_, out_.values),
                          {x_dot.data() + signal.first_state,
                           static_cast<std::size_t>(signal.block->num_states())});
    }
  }

 private:
  /// Whether it follows from the motion without other signals.
  bool depends_on_motion(const Signal& signal) const {
    if (signal.kind == Signal::Kind::reading && signal.reading->load >= 0) {
      return !model_.loads[static_cast<std::size_t>(signal.reading->load)].element->uses_signals();
    }
    return signal.kind != Signal::Kind::formula && signal.kind != Signal::Kind::block &&
           signal.kind != Signal::Kind::force;
  }
  double& value(int k) { return out_.values[static_cast<std::size_t>(k) + 1]; }
  static std::span<const double> states(const Signal& signal, const Vector& x) {
    return {x.data() + signal.first_state, static_cast<std::size_t>(signal.block->num_states())};
  }
  spatial::MarkerMotion marker(const model::MarkerId& id) const {
    return evaluate_marker(model_, id, motions_).motion;
  }

  double motion_value(const Signal& signal) const {
    if (signal.kind == Signal::Kind::position) {
      return signal.along.dot(marker(signal.marker).p + model_.origin);
    }
    if (signal.kind == Signal::Kind::velocity) return signal.along.dot(marker(signal.marker).v);
    if (signal.kind == Signal::Kind::reading) {
      return read_motion(model_, *signal.reading, motions_, t_, around_);
    }
    const loads::CoordinateMotion motion = coordinate_motion(
        model_, static_cast<std::size_t>(signal.coordinate), t_, around_.memory, motions_);
    const bool is_shifted = signal.coordinate == shift_.coordinate;
    return signal.kind == Signal::Kind::coordinate
               ? motion.value + (is_shifted ? shift_.value : 0.0)
               : motion.rate + (is_shifted ? shift_.rate : 0.0);
  }

  /// Of a law on a joint coordinate, which may be shifted.
  double force_of(const Signal& signal) const {
    const auto index = static_cast<std::size_t>(signal.load);
    const model::Load& load = model_.loads[index];
    const LoadEnds ends = ends_of(model_, load, motions_, around_.memory);
    if (load.coordinate != shift_.coordinate) {
      return action_of(model_, index, t_, around_, ends).along_coordinate;
    }
    if (around_.memory != nullptr && around_.memory->is_off(index)) return 0.0;
    loads::Sight sight = sight_of(model_, index, t_, around_, ends);
    sight.coordinate.value += shift_.value;
    sight.coordinate.change += shift_.value;
    sight.coordinate.rate += shift_.rate;
    return load.element->respond(sight).along_coordinate;
  }

  double made_value(const Signal& signal, const Vector& x) const {
    if (signal.kind == Signal::Kind::formula) return signal.input.value(t_, out_.values);
    if (signal.kind == Signal::Kind::force) return signal.factor * force_of(signal);
    if (signal.kind == Signal::Kind::reading) return motion_value(signal);
    if (const model::FunctionSignal* function = model::function_of(signal)) {
      return function->value_at(t_, out_.values);
    }
    const model::ControlBlock& block = *signal.block;
    const double u = block.feeds_through() ? signal.input.value(t_, out_.values) : 0.0;
    return block.value(states(signal, x), u);
  }

  const model::Model& model_;
  const std::vector<BodyMotion>& motions_;
  double t_;
  Circumstances around_;
  CoordinateShift shift_;
  SignalValues& out_;
};

bool knows_signals(const model::RowMemory* memory) {
  return memory != nullptr && !memory->signals.empty();
}

Vector start_states(const model::Model& model) {
  Vector x = Vector::Zero(model.signals.num_states);
  for (const Signal& signal : model.signals.all) {
    if (!signal.block) continue;
    signal.block->start(
        {x.data() + signal.first_state, static_cast<std::size_t>(signal.block->num_states())});
  }
  return x;
}

/// Rates of the method at the start of a step of length h, which move with it, and what is known of
/// those at its end.
void find_method_rates(const FirstOrderScheme& scheme, const model::RowMemory& memory, double h,
                       SignalValues& s) {
  const Eigen::Index n = s.x.size();
  const auto rate = memory.blocks.segment(n, n);
  const double scale = memory.block_step > 0.0 ? h / memory.block_step : 1.0;
  s.method_rates = rate + scale * (memory.blocks.tail(n) - rate);
  scheme.find_known(rate, s.method_rates, s.known);
}

const Signal& owner_of_state(const model::Model& model, Eigen::Index state) {
  const Signal* owner = nullptr;
  for (const Signal& signal : model.signals.all) {
    if (signal.block && signal.first_state <= state) owner = &signal;
  }
  return *owner;
}

/// 1 − e ∂ẋ/∂x by differences, factorised.
void form_tangent(Evaluation& at, double e, SignalValues& s) {
  const Eigen::Index n = s.x.size();
  at.evaluate(s.x, s.x_dot);
  s.tangent.setIdentity(n, n);
  s.rates.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double kept = s.x[k];
    const double d = kDifference * (1.0 + std::abs(kept));
    s.x[k] = kept + d;
    at.evaluate(s.x, s.rates);
    s.tangent.col(k) -= (e / d) * (s.rates - s.x_dot);
    s.x[k] = kept;
  }
  s.factor.compute(s.tangent);
}

/// x⁺ = fixed + e ẋ⁺(x⁺) by Newton's method with a tangent by differences, formed again where it
/// does not lead on: limits bend rates.
void solve_states(const model::Model& model, Evaluation& at, double e, SignalValues& s) {
  form_tangent(at, e, s);
  double before = HUGE_VAL;
  for (int iteration = 0;; ++iteration) {
    s.right = s.fixed + e * s.x_dot - s.x;
    s.open = s.factor.solve(s.right);
    s.x += s.open;
    at.evaluate(s.x, s.x_dot);
    Eigen::Index worst = 0;
    const double change = s.open.cwiseAbs().maxCoeff(&worst);
    const double scale = s.x.cwiseAbs().maxCoeff();
    if (change <= kSettled * scale) return;
    const bool is_slow = change > 0.3 * before;
    if (is_slow && change <= kRounding * scale) return;
    if (is_slow && std::isfinite(change)) form_tangent(at, e, s);
    before = change;
    if (iteration < kMostIterations && std::isfinite(change)) continue;
    const Signal& signal = owner_of_state(model, worst);
    throw NumericalError(
        signal.where,
        fmt::format(
            "the states of signal \"{}\" do not settle at t = {:.6g} s; use a smaller step, "
            "or look for a formula that jumps or grows without bound",
            signal.name, s.values[0]));
  }
}

bool is_due(const model::ControlBlock& block, double t) {
  if (block.samples_each_step()) return true;
  const double T = block.sample_time();
  return T > 0.0 && std::abs(t - T * std::round(t / T)) <= kSampleInstant * T;
}

/// Takes what is due at t. @return whether anything was
bool take_samples(const model::Model& model, double t, SignalValues& s) {
  bool took = false;
  for (const Signal& signal : model.signals.all) {
    if (!signal.block || !is_due(*signal.block, t)) continue;
    // Inputs are those before any sample of this instant: the order of signals does not matter.
    signal.block->sample(
        {s.x.data() + signal.first_state, static_cast<std::size_t>(signal.block->num_states())},
        signal.input.value(t, s.values));
    took = true;
  }
  return took;
}

/// @throws NumericalError naming a signal whose states have left all bounds
void require_bounded(const model::Model& model, const SignalValues& s) {
  Eigen::Index worst = 0;
  if (s.x.size() == 0 || s.x.cwiseAbs().maxCoeff(&worst) < kWithoutBound) return;
  const Signal& signal = owner_of_state(model, worst);
  throw NumericalError(
      signal.where,
      fmt::format(
          "signal \"{}\" has grown to {:.3g} at t = {:.6g} s: what it controls diverges; "
          "check the sign of its feedback and its gains, {}",
          signal.name, s.x[worst], s.values[0],
          signal.held ? "or put a `lag` into it" : "give it `limits`, or use a smaller step"));
}

/// @param around with the memory at the start of the step
void write_memory(const model::Model& model, const std::vector<BodyMotion>& motions,
                  const Circumstances& around, const SignalValues& s, const Vector& method_rate,
                  double h, model::RowMemory& out) {
  const Eigen::Index n = s.x.size();
  write_drives(model, motions, around, s, out.rows);
  out.signals = s.values;
  out.blocks.resize(3 * n);
  out.blocks << s.x, s.x_dot, method_rate;
  out.block_step = h;
}

}  // namespace

void evaluate_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const Circumstances& around, SignalValues& out,
                      const CoordinateShift& shift) {
  const Eigen::Index n = model.signals.num_states;
  Evaluation at(model, motions, t, around, shift, out);
  out.x_dot.resize(n);
  if (!knows_signals(around.memory)) {
    out.x = start_states(model);
    return at.evaluate(out.x, out.x_dot);
  }
  const model::RowMemory& memory = *around.memory;
  const double h = t - memory.signals[0];
  out.x = memory.blocks.head(n);
  if (n == 0 || h <= kSameInstant * memory.block_step) return at.evaluate(out.x, out.x_dot);
  const FirstOrderScheme scheme(model.signals.rho);
  find_method_rates(scheme, memory, h, out);
  out.fixed = out.x + h * ((1.0 - scheme.gamma) * out.method_rates + scheme.gamma * out.known);
  solve_states(model, at, h * scheme.gamma * scheme.share_of_rate(), out);
}

Circumstances with_signals(const model::Model& model, const std::vector<BodyMotion>& motions,
                           double t, const Circumstances& given, SignalValues& values) {
  Circumstances out = given;
  if (model.signals.empty() || given.signals != nullptr) return out;
  evaluate_signals(model, motions, t, given, values);
  out.signals = &values.values;
  return out;
}

void start_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                   model::RowMemory& memory, const std::vector<StateChange>& changes) {
  if (model.signals.empty()) return;
  SignalValues s;
  memory.signals.clear();
  const Circumstances around{nullptr, &memory, nullptr, nullptr, nullptr};
  evaluate_signals(model, motions, t, around, s);
  if (!changes.empty()) {
    for (const StateChange& change : changes) s.x[change.state] = change.value;
    Evaluation(model, motions, t, around, {}, s).evaluate(s.x, s.x_dot);
  }
  if (take_samples(model, t, s)) {
    Evaluation(model, motions, t, around, {}, s).evaluate(s.x, s.x_dot);
  }
  write_memory(model, motions, around, s, s.x_dot, 0.0, memory);
}

void change_states(const model::Model& model, const std::vector<BodyMotion>& motions,
                   const Circumstances& around, const std::vector<StateChange>& changes,
                   model::RowMemory& memory, Samples samples) {
  const Eigen::Index n = model.signals.num_states;
  const double t = memory.signals[0];
  SignalValues s;
  s.x = memory.blocks.head(n);
  s.x_dot.resize(n);
  for (const StateChange& change : changes) s.x[change.state] = change.value;
  Evaluation(model, motions, t, around, {}, s).evaluate(s.x, s.x_dot);
  if (samples == Samples::are_due && take_samples(model, t, s)) {
    Evaluation(model, motions, t, around, {}, s).evaluate(s.x, s.x_dot);
    require_bounded(model, s);
  }
  // The rates of the method jump with those of the states.
  const Vector a = memory.blocks.tail(n) + (s.x_dot - memory.blocks.segment(n, n));
  write_memory(model, motions, around, s, a, memory.block_step, memory);
}

void advance_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     const Circumstances& around, model::RowMemory& out) {
  if (model.signals.empty()) return;
  thread_local SignalValues s;  // kept, so that steps allocate nothing
  evaluate_signals(model, motions, t, around, s);
  const double h = t - around.memory->signals[0];
  const FirstOrderScheme scheme(model.signals.rho);
  find_method_rates(scheme, *around.memory, h, s);
  Vector& a = s.known;
  a += scheme.share_of_rate() * s.x_dot;
  if (!model.signals.has_held_readings() && take_samples(model, t, s)) {
    s.rates = s.x_dot;
    Evaluation(model, motions, t, around, {}, s).evaluate(s.x, s.x_dot);
    a += s.x_dot - s.rates;  // what held values drive jumps with them
  }
  require_bounded(model, s);
  write_memory(model, motions, around, s, a, h, out);
}

}  // namespace buckens::dynamics
