// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_settings.h"

#include <algorithm>

#include "buckens/loads/contact_friction.h"
#include "buckens/loads/contact_law.h"

namespace buckens::loads {

namespace {

/// What the settings say, not below zero; the number itself where they say nothing.
double set_value(std::span<const double> signals, int place, double otherwise) {
  if (place == 0 || signals.empty()) return otherwise;
  return std::max(0.0, signals[static_cast<std::size_t>(place)]);
}

void put_friction(const ContactSettings& settings, std::span<const double> signals,
                  double& static_coefficient, double& dynamic_coefficient) {
  static_coefficient = set_value(signals, settings.static_coefficient, static_coefficient);
  dynamic_coefficient = std::min(
      static_coefficient, set_value(signals, settings.dynamic_coefficient, dynamic_coefficient));
}

}  // namespace

void ContactSettings::put(std::span<const double> signals, ContactData& data) const {
  data.stiffness = set_value(signals, stiffness, data.stiffness);
  data.damping = set_value(signals, damping, data.damping);
  if (restitution > 0 && !signals.empty()) {
    data.loss = loss_factor(
        std::clamp(signals[static_cast<std::size_t>(restitution)], kLeastElasticRestitution, 1.0));
  }
  put_friction(*this, signals, data.static_coefficient, data.dynamic_coefficient);
}

void ContactSettings::put(std::span<const double> signals, ContactFrictionData& data) const {
  put_friction(*this, signals, data.static_coefficient, data.dynamic_coefficient);
}

double ContactSettings::restitution_at(std::span<const double> signals, double otherwise) const {
  return std::min(1.0, set_value(signals, restitution, otherwise));
}

}  // namespace buckens::loads
