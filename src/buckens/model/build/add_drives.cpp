// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_drives.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/function_signal.h"

namespace buckens::model {

namespace {

// How often a signal can be differentiated until accelerations, forces or jumps show.
constexpr int kSmooth = 3;

int add(Signal signal, Model& model) {
  model.signals.all.push_back(std::move(signal));
  return static_cast<int>(model.signals.all.size()) - 1;
}

Signal integral_of(base::SignalLaw input, const joints::JointSpec& joint, const char* what) {
  Signal out;
  out.name = fmt::format("{} ({})", joint.name, what);
  out.where = joint.where;
  out.kind = Signal::Kind::block;
  out.input = std::move(input);
  out.block = make_linear_block(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Ones(1),
                                Eigen::VectorXd::Ones(1), 0.0, Eigen::VectorXd::Zero(1));
  return out;
}

/// A formula that is one signal.
base::SignalLaw itself(int signal, const Model& model) {
  return base::SignalLaw::of(model.signals.all[static_cast<std::size_t>(signal)].name, signal);
}

/// How smooth all signals are; those that feed back into themselves are as smooth as what else
/// enters.
class Smoothness {
 public:
  explicit Smoothness(const Model& model)
      : all_(model.signals.all), of_(model.signals.all.size(), kSmooth) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < all_.size(); ++k) {
        const int now = look(all_[k]);
        changed = changed || now != of_[k];
        of_[k] = now;
      }
    }
  }

  int of(const base::SignalLaw& law) const {
    int out = kSmooth;
    for (const int k : law.places) out = std::min(out, of_[static_cast<std::size_t>(k)]);
    return out;
  }
  /// What limits a formula: the signal at the end of its roughest way.
  const Signal& roughest(const base::SignalLaw& law) const {
    const auto rougher = [this](int a, int b) {
      return of_[static_cast<std::size_t>(a)] < of_[static_cast<std::size_t>(b)];
    };
    const Signal* at = &all_[static_cast<std::size_t>(
        *std::min_element(law.places.begin(), law.places.end(), rougher))];
    for (std::size_t steps = 0; steps < all_.size() && passes_on(*at); ++steps) {
      const std::vector<int>& next = at->input.places;
      at = &all_[static_cast<std::size_t>(*std::min_element(next.begin(), next.end(), rougher))];
    }
    return *at;
  }

 private:
  static bool passes_on(const Signal& signal) {
    const bool is_open = signal.kind == Signal::Kind::formula ||
                         (signal.block && !signal.block->is_held() && signal.block->is_linear());
    return is_open && !signal.input.places.empty();
  }
  int look(const Signal& signal) const {
    switch (signal.kind) {
      case Signal::Kind::formula:
        return of(signal.input);
      case Signal::Kind::coordinate:
      case Signal::Kind::position:
        return 1;
      case Signal::Kind::block:
        break;
      default:
        return 0;
    }
    if (signal.block->is_held() || function_of(signal) != nullptr) return 1;
    const int behind = of(signal.input) + signal.block->relative_degree();
    // Limits make corners.
    return std::min(behind, signal.block->is_linear() ? kSmooth : 1);
  }

  const std::vector<Signal>& all_;
  std::vector<int> of_;
};

const char* what_is(const Signal& signal) {
  switch (signal.kind) {
    case Signal::Kind::coordinate:
    case Signal::Kind::position:
      return "a measured position: what holds two positions together at once is a `coupler`";
    case Signal::Kind::block:
      return signal.block->is_held() ? "which jumps" : "which has corners";
    default:
      return "a measured speed or force, which depends on what the drive does at that instant";
  }
}

/// Values at t = 0 of what follows from time and states of blocks alone.
std::vector<double> start_values(const Model& model) {
  std::vector<double> out(model.signals.all.size() + 1, 0.0);
  for (const int k : model.signals.order) {
    const Signal& signal = model.signals.all[static_cast<std::size_t>(k)];
    double& value = out[static_cast<std::size_t>(k) + 1];
    if (signal.kind == Signal::Kind::formula) value = signal.input.value(0.0, out);
    if (!signal.block || function_of(signal) != nullptr) continue;
    std::vector<double> x(static_cast<std::size_t>(signal.block->num_states()));
    signal.block->start(x);
    const double u = signal.block->feeds_through() ? signal.input.value(0.0, out) : 0.0;
    value = signal.block->value(x, u);
  }
  return out;
}

/// Those signals in the order of evaluation on which drives depend.
std::vector<int> steering_signals(const Model& model) {
  std::vector<char> needed(model.signals.all.size(), 0);
  std::vector<int> open;
  for (const Drive& drive : model.drives) open.push_back(drive.signal);
  while (!open.empty()) {
    const auto k = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (needed[k] != 0) continue;
    needed[k] = 1;
    const std::vector<int>& inputs = model.signals.all[k].input.places;
    open.insert(open.end(), inputs.begin(), inputs.end());
  }
  std::vector<int> out;
  for (const int k : model.signals.order) {
    if (needed[static_cast<std::size_t>(k)] != 0) out.push_back(k);
  }
  return out;
}

/// @throws ModelError if a drive cannot follow its law
void require_smooth(const joints::JointSpec& spec, const Smoothness& smoothness) {
  const joints::DriveLaws laws = spec.laws();
  const bool turns = spec.drives_angle();
  const auto check = [&](const std::optional<base::SignalLaw>& law, int needed, const char* key,
                         const char* instead) {
    if (!law || smoothness.of(*law) >= needed) return;
    const Signal& signal = smoothness.roughest(*law);
    throw ModelError(
        spec.where,
        fmt::format("joint \"{}\": its `{}` follows signal \"{}\", {}; give its `{}` instead, or "
                    "put a `lag` or an `integral` behind that signal",
                    spec.name, key, signal.name, what_is(signal), instead));
  };
  check(laws.position, 2, turns ? "angle" : "displacement", turns ? "speed" : "velocity");
  const bool is_own = std::holds_alternative<joints::PrescribedCoordinateSpec>(spec.kind);
  check(laws.rate, 1, turns ? "speed" : "velocity",
        turns && is_own ? "angular-acceleration" : "acceleration");
}

}  // namespace

void add_drives(const ModelDescription& description, Model& model) {
  for (const joints::JointSpec& spec : description.joints) {
    const joints::DriveLaws laws = spec.laws();
    if (!laws.is_steered()) continue;
    Drive drive;
    const auto owner = std::find_if(model.joints.begin(), model.joints.end(),
                                    [&](const Joint& joint) { return joint.name == spec.name; });
    drive.joint = static_cast<int>(owner - model.joints.begin());
    if (laws.position) {
      Signal position;
      position.name = spec.name + " (position)";
      position.where = spec.where;
      position.input = *laws.position;
      drive.signal = add(std::move(position), model);
    } else if (laws.rate) {
      drive.signal = add(integral_of(*laws.rate, spec, "position"), model);
    } else {
      const int rate = add(integral_of(*laws.acceleration, spec, "rate"), model);
      drive.signal = add(integral_of(itself(rate, model), spec, "position"), model);
    }
    model.drives.push_back(drive);
  }
}

void settle_drives(const ModelDescription& description, Model& model) {
  if (model.drives.empty()) return;
  const Smoothness smoothness(model);
  for (const joints::JointSpec& spec : description.joints) {
    if (spec.laws().is_steered()) require_smooth(spec, smoothness);
  }
  model.signals.steering = steering_signals(model);
  const std::vector<double> values = start_values(model);
  for (const Drive& drive : model.drives) {
    joints::ConstraintRow& row = model.joints[static_cast<std::size_t>(drive.joint)].rows.back();
    row = row.steered(values[static_cast<std::size_t>(drive.signal) + 1]);
  }
}

}  // namespace buckens::model
