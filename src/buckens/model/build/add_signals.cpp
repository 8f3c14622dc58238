// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_signals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/model/build/add_joint_law.h"
#include "buckens/model/function_signal.h"
#include "buckens/model/spec/description_member.h"

namespace buckens::model {

namespace {

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::shared_ptr<const ControlBlock> block_of(const IntegralSpec& spec) {
  return make_linear_block(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Ones(1),
                           Eigen::VectorXd::Ones(1), 0.0, Eigen::VectorXd::Constant(1, spec.start));
}

std::shared_ptr<const ControlBlock> block_of(const LagSpec& spec) {
  const double rate = 1.0 / spec.time_constant;
  return make_linear_block(Eigen::MatrixXd::Constant(1, 1, -rate),
                           Eigen::VectorXd::Constant(1, rate), Eigen::VectorXd::Ones(1), 0.0,
                           Eigen::VectorXd::Constant(1, spec.start));
}

std::shared_ptr<const ControlBlock> block_of(const TransferFunctionSpec& spec) {
  return make_transfer_function(spec.numerator, spec.denominator);
}

std::shared_ptr<const ControlBlock> block_of(const StateSpaceSpec& spec) {
  const auto n = static_cast<Eigen::Index>(spec.A.size());
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index k = 0; k < n; ++k) A.row(k) = vector_of(spec.A[static_cast<std::size_t>(k)]);
  return make_linear_block(
      std::move(A), vector_of(spec.B), vector_of(spec.C), spec.D,
      spec.start.empty() ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : vector_of(spec.start));
}

std::shared_ptr<const ControlBlock> block_of(const PidSpec& spec) {
  PidData data;
  data.proportional = spec.proportional;
  data.integral = spec.integral;
  data.derivative = spec.derivative;
  data.filter = spec.filter.value_or(0.0);
  data.lowest = spec.limits ? (*spec.limits)[0] : -HUGE_VAL;
  data.highest = spec.limits ? (*spec.limits)[1] : HUGE_VAL;
  data.sample = spec.sample.value_or(0.0);
  const bool has_both = spec.proportional != 0.0 && spec.integral != 0.0;
  data.tracking =
      spec.tracking.value_or(has_both ? std::abs(spec.proportional / spec.integral) : 1.0);
  return make_pid(data);
}

std::shared_ptr<const ControlBlock> block_of(const SampleHoldSpec& spec) {
  return make_sample_hold(spec.sample);
}

std::shared_ptr<const ControlBlock> block_of(const SwitchSpec& spec) {
  return make_switch(spec.on, spec.off, spec.start);
}

std::shared_ptr<const ControlBlock> block_of(const TableSignalSpec& spec) {
  std::vector<double> inputs, values;
  for (const auto& [input, value] : spec.points) {
    inputs.push_back(input);
    values.push_back(value);
  }
  return make_table_block(base::TimeLaw::table(std::move(inputs), std::move(values),
                                               spec.interpolation, spec.extrapolation, spec.where));
}

std::shared_ptr<const ControlBlock> block_of(const RateLimitSpec& spec) {
  return make_rate_limit(spec.rising, spec.falling, spec.time_constant, spec.start);
}

std::shared_ptr<const ControlBlock> block_of(const SettingSpec& spec) {
  return make_setting(spec.start);
}

class SignalBuilder {
 public:
  SignalBuilder(const SignalSpec& spec, MarkerFinder& find) : spec_(spec), find_(find) {
    out_.name = spec.name;
    out_.where = spec.where;
  }

  Signal build() {
    if (spec_.value) out_.input = *spec_.value;
    for (const JointReading& read : joint_readings(spec_)) {
      coordinate(*read.joint, read.which,
                 read.is_rate ? Signal::Kind::coordinate_rate : Signal::Kind::coordinate);
    }
    marker(spec_.position, Signal::Kind::position);
    marker(spec_.velocity, Signal::Kind::velocity);
    if (spec_.force_of) out_.kind = Signal::Kind::force;
    if (spec_.sensor) {
      out_.kind = Signal::Kind::block;
      out_.held = {spec_.sensor->of, spec_.sensor->component};
      out_.block = make_setting(spec_.sensor->start);
    }
    block(spec_.integral);
    block(spec_.lag);
    block(spec_.transfer_function);
    block(spec_.state_space);
    block(spec_.pid);
    block(spec_.sample_hold);
    block(spec_.table);
    block(spec_.rate_limit);
    block(spec_.switched);
    block(spec_.setting);
    return std::move(out_);
  }

 private:
  void coordinate(const std::string& joint, std::optional<base::CoordinateChoice> which,
                  Signal::Kind kind) {
    out_.kind = kind;
    out_.coordinate = find_coordinate(joint, which, base::CoordinateSort::any, find_);
    if (out_.coordinate >= 0) return;
    throw ModelError(spec_.where,
                     fmt::format("signal \"{}\": there is no joint \"{}\"", spec_.name, joint));
  }
  void marker(const std::optional<MarkerSignalSpec>& seen, Signal::Kind kind) {
    if (!seen) return;
    out_.kind = kind;
    out_.marker = find_.marker(seen->of, false);
    out_.along = seen->along.normalized();
  }
  template <class Spec>
  void block(const std::optional<Spec>& spec) {
    if (!spec) return;
    out_.kind = Signal::Kind::block;
    if constexpr (requires { spec->input; }) out_.input = spec->input;
    out_.block = block_of(*spec);
  }

  const SignalSpec& spec_;
  MarkerFinder& find_;
  Signal out_;
};

/// Puts signals after those that they depend on at the same instant.
class Sorter {
 public:
  Sorter(const ModelDescription& description, Model& model)
      : description_(description), model_(model), mark_(model.signals.all.size(), Mark::unseen) {}

  void run() {
    for (std::size_t k = 0; k < mark_.size(); ++k) visit(k);
  }

 private:
  enum class Mark { unseen, open, done };

  /// Whether k needs j at the same instant.
  bool needs(std::size_t k, std::size_t j) const {
    const Signal& signal = model_.signals.all[k];
    const std::string& name = model_.signals.all[j].name;
    if (const FunctionSignal* function = function_of(signal)) return function->takes(name);
    if (signal.kind == Signal::Kind::formula) return signal.input.uses(name);
    if (signal.block) return signal.block->feeds_through() && signal.input.uses(name);
    const int load = signal.reading ? signal.reading->load : signal.load;
    return load >= 0 && law_uses(model_.loads[static_cast<std::size_t>(load)].name, name);
  }

  /// Whether a force law follows a signal.
  bool law_uses(const std::string& load, const std::string& signal) const {
    const auto known = laws_.try_emplace(load);
    if (known.second) known.first->second = laws_of(load);
    return std::any_of(known.first->second.begin(), known.first->second.end(),
                       [&](const base::SignalLaw* law) { return law->uses(signal); });
  }

  /// The numbers of a load, or of a joint with a force law, that may follow signals.
  std::vector<const base::SignalLaw*> laws_of(const std::string& load) const {
    std::vector<const base::SignalLaw*> out;
    const base::Member description = description_member(description_);
    for (const char* list : {"loads", "joints"}) {
      for (const base::Member& entry : field_member(description, list).parts()) {
        if (*entry.type->name(entry.at) != load) continue;
        for (const base::Field& field : kind_member(entry).fields()) {
          const auto* optional = field.member.get<std::optional<base::SignalLaw>>();
          if (optional != nullptr && *optional) out.push_back(&**optional);
          if (const auto* law = field.member.get<base::SignalLaw>()) out.push_back(law);
        }
        return out;
      }
    }
    return out;
  }

  void visit(std::size_t k) {
    if (mark_[k] == Mark::done) return;
    path_.push_back(k);
    if (mark_[k] == Mark::open) refuse_loop();
    mark_[k] = Mark::open;
    for (std::size_t j = 0; j < mark_.size(); ++j) {
      if (needs(k, j)) visit(j);
    }
    mark_[k] = Mark::done;
    path_.pop_back();
    model_.signals.order.push_back(static_cast<int>(k));
  }

  [[noreturn]] void refuse_loop() const {
    const auto first = std::find(path_.begin(), path_.end(), path_.back());
    std::string names;
    for (auto it = first; it != path_.end(); ++it) {
      names += (it == first ? "\"" : " needs \"") + model_.signals.all[*it].name + '"';
    }
    throw ModelError(model_.signals.all[path_.back()].where,
                     fmt::format("signals form an algebraic loop: {}; break it with a `lag`, an "
                                 "`integral` or a `sample-hold`",
                                 names));
  }

  const ModelDescription& description_;
  Model& model_;
  std::vector<Mark> mark_;
  std::vector<std::size_t> path_;
  mutable std::map<std::string, std::vector<const base::SignalLaw*>>
      laws_;  ///< by load, once asked
};

}  // namespace

void add_signals(const ModelDescription& description, MarkerFinder& find) {
  for (const SignalSpec& spec : description.signals) {
    find.model().signals.all.push_back(SignalBuilder(spec, find).build());
  }
}

void connect_signals(const ModelDescription& description, Model& model) {
  SignalSet& signals = model.signals;
  signals.num_states = 0;
  signals.order.clear();
  for (std::size_t k = 0; k < signals.all.size(); ++k) {
    Signal& signal = signals.all[k];
    if (signal.block) {
      signal.first_state = signals.num_states;
      signals.num_states += signal.block->num_states();
    }
    if (signal.kind != Signal::Kind::force || signal.load >= 0) continue;
    const std::string& name = *description.signals[k].force_of;
    const auto load = std::find_if(model.loads.begin(), model.loads.end(), [&](const Load& one) {
      return one.name == name && one.coordinate >= 0;
    });
    if (load == model.loads.end()) {
      throw ModelError(signal.where,
                       fmt::format("signal \"{}\": there is no load \"{}\" on the coordinate of a "
                                   "joint (a hinge- or slide- spring, stop, friction or motor)",
                                   signal.name, name));
    }
    signal.load = static_cast<int>(load - model.loads.begin());
  }
  if (description.simulation &&
      description.simulation->method == IntegrationMethod::generalized_alpha) {
    signals.rho = description.simulation->rho_inf;
  }
  Sorter(description, model).run();
}

}  // namespace buckens::model
