// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/dynamics/signals.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {

/// What events do to the state in which they find the mechanism.
///
/// Settings, switches and locks change what acts from here on; a lock that stops a moving joint is
/// an impact, in which the other joints and all masses take part. Accelerations follow when all
/// events of an instant have acted, see settle(). Theory: docs/theory/24-control.md §5.
class EventActions {
 public:
  EventActions(const model::BuiltModel& built, const dynamics::MassMetric& metric)
      : built_(built), metric_(metric) {}

  /// What it has done to the energy.
  struct Effect {
    /// By springs that were switched on or changed, less those switched off, by weights as gravity
    /// changed, and by joints that were closed the last bit [J].
    double gained = 0;
    double lost = 0;  ///< when moving joints were locked [J]
  };
  /// @param stepper is asked where something strikes, for one whose steps tell how meshes answer
  /// @throws NumericalError if locks cannot stop the mechanism
  Effect apply(const model::EventSpec& event,
               const std::function<const stepping::Stepper&()>& stepper, model::State& state) const;

  /// Finds the accelerations and multipliers that belong to what acts now.
  /// @throws NumericalError as settle_rigid_rows()
  void settle(model::State& state) const;

 private:
  void set_signals(const model::EventSpec& event, model::State& state) const;
  void strain_contacts(model::State& state) const;
  void follow_signals(const std::vector<dynamics::StateChange>& changes, model::State& state) const;
  void switch_loads(const std::vector<std::string>& names, bool on, model::State& state) const;
  bool hold_joint(const std::string& name, bool is_held, model::State& state) const;
  void release_joint(const std::string& name, model::State& state) const;
  /// @throws NumericalError if it is too far open
  void attach_joint(const std::string& name, const model::EventSpec& event,
                    model::State& state) const;
  /// Lets what a joint remembers look where its markers are. @throws NumericalError if a slider is
  /// beside its beam's ends
  void look_anew(const model::Joint& joint, const model::EventSpec& event,
                 model::State& state) const;
  /// @param play half the play between teeth along the line of action [m]
  void require_meshing(const model::Joint& joint, double play, const model::EventSpec& event,
                       double t) const;
  void require_closed(const model::Joint& joint, const model::EventSpec& event,
                      const model::State& state) const;
  std::vector<int> rows_in_use(const model::State& state) const;

  const model::BuiltModel& built_;
  const dynamics::MassMetric& metric_;
};

}  // namespace buckens::analysis
