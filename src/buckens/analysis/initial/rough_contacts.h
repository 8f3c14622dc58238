// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"
#include "buckens/stepping/contact_cones.h"

namespace buckens::analysis {

/// Rigid contacts with friction at an instant. Their stands are decided for all of them together.
/// Theory: docs/theory/25-contact.md §4.
class RoughContacts {
 public:
  /// A time in which bodies do not move: what friction would stop within it sticks, and what begins
  /// to slide has a direction at its end [s].
  static constexpr double kInstant = 1e-6;

  /// @param model,metric,rows_in_use must outlive this object
  RoughContacts(const model::Model& model, const dynamics::MassMetric& metric,
                const std::vector<int>& rows_in_use);

  /// Whether a row is decided here.
  bool owns(int rigid_row) const { return cones_.rows()[static_cast<std::size_t>(rigid_row)] != 0; }

  /// Decides the stands from accelerations, unless many decisions before have changed none.
  /// @param forces at the state
  /// @return whether any stand has changed
  bool decide(const dynamics::Forces& forces, model::State& state);

  /// Finds forces that act throughout a span of time and satisfy Coulomb's law at its end, and the
  /// accelerations that they cause. At an instant such forces need not exist (Painlevé), or they
  /// cannot be distinguished from others.
  /// @param span [s]
  void hold_over(double span, model::State& state);
  /// Whether accelerations would change velocities within a span by more than the fastest slip plus
  /// a multiple of what weight does. Near a jam, forces at an instant grow without bound, but they
  /// would last for that instant only. @param span of a step [s]
  bool are_sudden(const model::State& state, double span) const;

 private:
  void write(model::State& state) const;
  /// Rates that rows would have after a span with the accelerations of a state.
  void foresee(const std::vector<dynamics::BodyMotion>& motions, const model::State& state,
               double span, std::vector<loads::RigidRow>& rows) const;

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  const std::vector<int>& rows_in_use_;
  stepping::ContactCones cones_;
  stepping::RigidRows rigid_;
  std::vector<dynamics::BodyCompliance> compliance_;
  dynamics::SoftRows soft_;
  int in_vain_ = 0;  ///< decisions since a stand has changed
};

}  // namespace buckens::analysis
