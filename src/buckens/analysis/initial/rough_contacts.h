// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"
#include "buckens/stepping/contact_cones.h"

namespace buckens::analysis {

/// Rigid contacts with friction, whose stands at an instant are decided for all of them together.
class RoughContacts {
 public:
  /// In this time bodies do not move: what friction would stop within it sticks, and what begins to
  /// slide has a direction at its end [s].
  static constexpr double kInstant = 1e-6;

  /// @param model,metric,rows_in_use must outlive this object
  RoughContacts(const model::Model& model, const dynamics::MassMetric& metric,
                const std::vector<int>& rows_in_use);

  /// Whether a row is decided here.
  bool owns(int rigid_row) const { return cones_.rows()[static_cast<std::size_t>(rigid_row)] != 0; }

  /// Decides by accelerations. @param forces at the state
  /// @return whether any stands otherwise now
  bool decide(const dynamics::Forces& forces, model::State& state);

  /// Finds forces that satisfy Coulomb's law at the end of a span of time that they act throughout,
  /// and the accelerations that they make. At an instant there need not be any (Painlevé), or the
  /// one that there is cannot be told from the others.
  /// @param span [s]
  void hold_over(double span, model::State& state);
  /// Whether accelerations would change velocities within a span by more than there is of slip, and
  /// by more than comes of weight. Near a jam forces of an instant grow without bound, which would
  /// last for that instant only. @param span of a step [s]
  bool are_sudden(const model::State& state, double span) const;

 private:
  void write(model::State& state) const;
  /// What the rates of rows would be after a span with the accelerations of a state.
  void foresee(const std::vector<dynamics::BodyMotion>& motions, const model::State& state,
               double span, std::vector<loads::RigidRow>& rows) const;

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  const std::vector<int>& rows_in_use_;
  stepping::ContactCones cones_;
  stepping::RigidRows rigid_;
  std::vector<dynamics::BodyCompliance> compliance_;
  dynamics::SoftRows soft_;
};

}  // namespace buckens::analysis
