// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/signal_law.h"
#include "buckens/base/source_location.h"

namespace buckens::model {

/// Direction in which a signal crosses zero.
enum class Crossing { rising, falling, both };

constexpr std::array<const char*, 3> choice_names(Crossing) {
  return {"rising", "falling", "both"};
}

enum class EventAction { note, stop };

constexpr std::array<const char*, 2> choice_names(EventAction) { return {"note", "stop"}; }

/// New value of a signal with a `setting`, of a parameter of a force law, or of gravity.
struct SettingChange {
  static constexpr bool kHasForeignName = true;  ///< "loads.damper.damping"
  std::string name;
  SourceLocation where;
  std::optional<base::SignalLaw> value;                  ///< of all but gravity
  std::optional<std::array<base::SignalLaw, 3>> vector;  ///< of gravity

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("value", value, "number, or formula of t and signals at that instant")
              .of_any_dimension()
              .shorthand()
              .like("\"0.5*angle\"")
              .otherwise("`vector`"));
    visit(base::field("vector", vector, "three of them, of `gravity`")
              .of_any_dimension()
              .shorthand()
              .like("[0, 0, -1.62 m/s^2]")
              .otherwise("`value`"));
  }
};

/// An action when a signal crosses zero.
struct EventSpec {
  std::string name;
  SourceLocation where;
  std::string when;  ///< name of a signal
  Crossing direction = Crossing::both;
  EventAction action = EventAction::note;
  std::vector<SettingChange> changes;
  std::vector<std::string> switch_on, switch_off;  ///< loads
  std::vector<std::string> lock, unlock, release;  ///< joints
  std::vector<std::string> attach;                 ///< joints
  std::optional<double> tolerance;                 ///< of `attach` [m]
  bool records = false;

  /// Whether it changes the motion.
  bool changes_motion() const {
    return !changes.empty() || !switch_on.empty() || !switch_off.empty() || !lock.empty() ||
           !unlock.empty() || !release.empty() || !attach.empty();
  }
  /// Whether its instant must be located.
  bool acts() const { return changes_motion() || records; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("when", when, "name of the signal that goes through zero")
              .required()
              .like("height"));
    visit(base::field("direction", direction, "which way it goes"));
    visit(base::field("do", action,
                      "`note` the time in the summary of the run, or note it and `stop`"));
    visit(base::field("set", changes,
                      "new values of signals with a `setting`, of parameters of springs, dampers, "
                      "friction in joints, motors, brakes and contacts, and of "
                      "`gravity`")
              .like("{target: 0.5, gain: \"2*gain\", loads.damper.damping: 20 N s/m, gravity: "
                    "[0, 0, -1.62 m/s^2]}"));
    visit(base::field("switch-on", switch_on, "loads, springs, motors … that act from now on")
              .like("[motor]"));
    visit(base::field("switch-off", switch_off, "loads, springs, motors … that no longer act")
              .like("[latch]"));
    joint_fields(visit);
    visit(base::field("record", records, "whether the results get a record of this instant")
              .on_off());
  }

 private:
  template <class Visitor>
  void joint_fields(Visitor& visit) {
    visit(base::field("lock", lock,
                      "joints whose angle and displacement are held as they are from now on; what "
                      "moves is stopped by an impact")
              .like("[hinge]"));
    visit(base::field("unlock", unlock, "joints that are free again after `lock`").like("[hinge]"));
    visit(base::field("release", release, "joints that hold nothing any more: they have let go")
              .like("[hook]"));
    visit(base::field("attach", attach,
                      "joints that had let go, or started so (`initial: {released: …}`), and hold "
                      "again; speeds are closed by an impact")
              .like("[gripper]"));
    visit(base::field("tolerance", tolerance,
                      "how far a joint that is attached may be open; the next step closes it")
              .in(base::kLength)
              .positive()
              .like("0.5 mm")
              .otherwise("a thousandth of the model's size"));
  }
};

}  // namespace buckens::model
