// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/contact_settings.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::loads {

/// The stop of two bodies in one place. Where the place has gone, as a corner that slides over the
/// border of a face, it lets go at once, whatever its force.
class ContactStop final : public RigidStop {
 public:
  ContactStop(const spatial::RigidTouch& touch, double restitution, double threshold,
              const ContactSettings& settings = {})
      : RigidStop(0.0, HUGE_VAL, restitution, threshold), touch_(touch), settings_(settings) {}

  Action respond(const Sight& sight) const override;
  int row_of_place() const override { return 0; }

 private:
  RigidRow row(const Sight& sight) const override;
  double restitution_at(std::span<const double> signals) const override {
    return settings_.restitution_at(signals, RigidStop::restitution_at(signals));
  }
  /// Whether it is closed in a place that is none.
  bool has_gone(const Sight& sight) const;

  spatial::RigidTouch touch_;
  ContactSettings settings_;
};

}  // namespace buckens::loads
