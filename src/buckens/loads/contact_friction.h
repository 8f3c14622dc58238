// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_settings.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::loads {

/// Parameters of dry friction where two bodies touch rigidly.
struct ContactFrictionData {
  double static_coefficient = 0;   ///< μ_s
  double dynamic_coefficient = 0;  ///< μ_d ≤ μ_s
  double stribeck_speed = 0;       ///< [m/s]; 0: the coefficient does not fall
  double at_rest = 0;              ///< speed below which its direction says nothing [m/s]

  /// μ at a speed of sliding [m/s].
  double coefficient(double speed) const;
};

/// Dry friction in one place of a rigid contact along one direction of its surface: a row that
/// closes the rate there as long as the cone |f| ≤ μ N of all its directions admits the force.
/// Regimes: 0 the bodies do not press; 1 sticks; 2 slides, with μ N against the slip;
/// kHeldDirection and more: slides with μ N in the direction of the stand's force, which the step
/// has found.
///
/// Its coordinate is a joints::ContactWay. The load before those of the directions is the one-sided
/// row across the surface; Sight::reaction is the force of all these rows.
class ContactFriction final : public RigidLaw {
 public:
  /// @param direction 0, or 1 of a surface with two
  ContactFriction(const spatial::RigidTouch& touch, const ContactFrictionData& data, int direction,
                  const ContactSettings& settings = {})
      : touch_(touch), data_(data), direction_(direction), settings_(settings) {}

  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  void find_states(const Sight& sight, double* states) const override;
  int direction() const { return direction_; }
  int row_of_place() const override { return 1 + direction_; }
  const spatial::RigidTouch& touch() const { return touch_; }
  /// As the model says: events do not count.
  const ContactFrictionData& data() const { return data_; }
  /// As events have left it. @param signals t and the values of all signals
  ContactFrictionData data_at(std::span<const double> signals) const;
  /// Derivative of the force by the size of the force across the surface.
  double slope(const Sight& sight) const;

 private:
  /// How it slides, or is about to.
  struct Slip {
    bool touches = true;  ///< there is something to rub on
    double load = 0;      ///< N [N]
    double speed = 0;     ///< [m/s]
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    Eigen::Vector2d force = Eigen::Vector2d::Zero();    ///< of the rows as they stand [N]
    Eigen::Vector2d towards = Eigen::Vector2d::Zero();  ///< unit vector of sliding, or zero
  };
  Slip slip(const Sight& sight) const;
  /// Whether it slid at the start of the step.
  static bool began_sliding(const Sight& sight);
  RigidRow row(const Sight& sight) const override;

  spatial::RigidTouch touch_;
  ContactFrictionData data_;
  int direction_;
  ContactSettings settings_;
};

}  // namespace buckens::loads
