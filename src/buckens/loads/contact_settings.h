// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace buckens::loads {

struct ContactData;
struct ContactFrictionData;

/// Parameters of a contact that events change, as indices into t and the values of all signals.
/// 0, the index of t, means the value of the model; so does a missing list of values.
/// Quantities derived from them when the model was built (thresholds, stiffness of sticking) do not
/// change.
struct ContactSettings {
  int stiffness = 0;
  int restitution = 0;
  int damping = 0;
  int static_coefficient = 0;
  int dynamic_coefficient = 0;  ///< where it stays, it is at most the other one

  /// Whether friction or the normal force law changes.
  bool any() const { return changes_across() || changes_friction(); }
  bool changes_across() const { return stiffness > 0 || restitution > 0 || damping > 0; }
  bool changes_friction() const { return static_coefficient > 0 || dynamic_coefficient > 0; }

  /// @param signals t and the values of all signals
  void put(std::span<const double> signals, ContactData& data) const;
  void put(std::span<const double> signals, ContactFrictionData& data) const;
  /// @param otherwise the restitution if it does not change
  double restitution_at(std::span<const double> signals, double otherwise) const;
};

}  // namespace buckens::loads
