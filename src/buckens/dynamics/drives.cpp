// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/drives.h"

#include "buckens/base/differentiate.h"
#include "buckens/dynamics/travel.h"
#include "buckens/model/function_signal.h"

namespace buckens::dynamics {

using model::Signal;

namespace {

/// Rates and accelerations of the signals that drives depend on, as far as they are known: else
/// zero. Drives are refused where they would matter (model::settle_drives).
class SignalMotions {
 public:
  SignalMotions(const model::Model& model, const std::vector<BodyMotion>& motions,
                const Circumstances& around, const SignalValues& signals)
      : model_(model),
        motions_(motions),
        around_(around),
        now_(signals),
        rates_(kept().rates),
        accelerations_(kept().accelerations),
        shifted_(kept().shifted),
        x_ddot_(kept().x_ddot) {
    for (std::vector<double>* values : {&rates_, &accelerations_, &shifted_}) {
      values->assign(signals.values.size(), 0.0);
    }
    x_ddot_.setZero(signals.x.size());
    rates_[0] = 1.0;
    for (const int k : model.signals.steering) rates_[place(k)] = rate(signal(k));
    for (const int k : model.signals.steering) {
      const Signal& own = signal(k);
      if (own.block && own.block->is_linear()) {
        own.block->rates(of(own, now_.x_dot), rate_of(own.input), of(own, x_ddot_));
      }
      accelerations_[place(k)] = acceleration(own);
    }
  }

  joints::Steering of(int k) const {
    return {now_.values[0], now_.values[place(k)], rates_[place(k)], accelerations_[place(k)]};
  }

 private:
  /// Kept, so that steps allocate nothing.
  struct Buffers {
    std::vector<double> rates, accelerations, shifted;  // t first, as the values
    linalg::Vector x_ddot;
  };
  static Buffers& kept() {
    thread_local Buffers buffers;
    return buffers;
  }
  static std::size_t place(int k) { return static_cast<std::size_t>(k) + 1; }
  const Signal& signal(int k) const { return model_.signals.all[static_cast<std::size_t>(k)]; }
  static std::span<const double> of(const Signal& signal, const linalg::Vector& x) {
    return {x.data() + signal.first_state, static_cast<std::size_t>(signal.block->num_states())};
  }
  static std::span<double> of(const Signal& signal, linalg::Vector& x) {
    return {x.data() + signal.first_state, static_cast<std::size_t>(signal.block->num_states())};
  }
  /// Whether a formula is one signal and nothing else.
  static bool is_one(const base::SignalLaw& law) {
    return law.places.size() == 1 && base::is_identifier(law.formula->text());
  }

  /// Along the motion as far as rates, and accelerations, are known.
  double ahead(const base::SignalLaw& law, double time, bool bent) {
    for (std::size_t k = 0; k < shifted_.size(); ++k) {
      shifted_[k] =
          now_.values[k] + time * (rates_[k] + (bent ? 0.5 * time * accelerations_[k] : 0));
    }
    return law.value(shifted_[0], shifted_);
  }

  double rate_of(const base::SignalLaw& law) {
    if (!law.formula) return law.law.rate(now_.values[0]);
    if (is_one(law)) return law.scale * rates_[place(law.places[0])];
    return base::derivative([&](double time) { return ahead(law, time, false); }, 0.0, 1)
        .value_or(0.0);
  }
  double acceleration_of(const base::SignalLaw& law) {
    if (!law.formula) return law.law.acceleration(now_.values[0]);
    if (is_one(law)) return law.scale * accelerations_[place(law.places[0])];
    return base::derivative([&](double time) { return ahead(law, time, true); }, 0.0, 2)
        .value_or(0.0);
  }

  double rate(const Signal& own) {
    switch (own.kind) {
      case Signal::Kind::formula:
        return rate_of(own.input);
      case Signal::Kind::coordinate:
        return coordinate_motion(model_, static_cast<std::size_t>(own.coordinate), now_.values[0],
                                 around_.memory, motions_)
            .rate;
      case Signal::Kind::position:
        return own.along.dot(evaluate_marker(model_, own.marker, motions_).motion.v);
      case Signal::Kind::block:
        break;
      default:
        return 0.0;
    }
    if (own.block->is_held() || model::function_of(own) != nullptr) return 0.0;
    const double u_dot = own.block->feeds_through() ? rate_of(own.input) : 0.0;
    if (own.block->is_linear()) return own.block->value(of(own, now_.x_dot), u_dot);
    const auto along = [&](double time) {
      const std::span<const double> x = of(own, now_.x), x_dot = of(own, now_.x_dot);
      std::vector<double> there(x.begin(), x.end());
      for (std::size_t k = 0; k < there.size(); ++k) there[k] += time * x_dot[k];
      return own.block->value(there, own.input.value(now_.values[0], now_.values) + time * u_dot);
    };
    return base::derivative(along, 0.0, 1).value_or(0.0);
  }

  double acceleration(const Signal& own) {
    if (own.kind == Signal::Kind::formula) return acceleration_of(own.input);
    if (own.kind != Signal::Kind::block || !own.block->is_linear()) return 0.0;
    const double u_ddot = own.block->feeds_through() ? acceleration_of(own.input) : 0.0;
    return own.block->value(of(own, x_ddot_), u_ddot);
  }

  const model::Model& model_;
  const std::vector<BodyMotion>& motions_;
  const Circumstances& around_;
  const SignalValues& now_;
  std::vector<double>&rates_, &accelerations_, &shifted_;
  linalg::Vector& x_ddot_;
};

}  // namespace

void write_drives(const model::Model& model, const std::vector<BodyMotion>& motions,
                  const Circumstances& around, const SignalValues& signals, linalg::Vector& rows) {
  if (model.drives.empty()) return;
  const SignalMotions all(model, motions, around, signals);
  for (const model::Drive& drive : model.drives) {
    const model::Joint& joint = model.joints[static_cast<std::size_t>(drive.joint)];
    int state = joint.first_state;  // of the driven row, the last one
    for (const joints::ConstraintRow& row : joint.rows) {
      if (!row.is_steered()) state += row.num_states();
    }
    all.of(drive.signal).write(rows.data() + state);
  }
}

void steer_drives(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                  const Circumstances& around, SignalValues& signals, model::RowMemory& memory) {
  if (model.drives.empty()) return;
  evaluate_signals(model, motions, t, around, signals);
  write_drives(model, motions, around, signals, memory.rows);
}

}  // namespace buckens::dynamics
