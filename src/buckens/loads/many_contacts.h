// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Place of the contacts of many bodies among the loads. Which of them touch changes all the time;
/// their forces come from the group that the model keeps beside its loads
/// (model/contact_group.h).
class ManyContacts final : public ForceElement {
 public:
  Action evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                  const spatial::MarkerMotion& /*second*/) const override {
    return {};
  }
};

}  // namespace buckens::loads
