// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/rigid_law.h"
#include "buckens/model/model.h"

namespace buckens::analysis {

/// The rigid stop that a load is, else null.
inline const loads::RigidStop* stop_of(const model::Load& load) {
  return dynamic_cast<const loads::RigidStop*>(load.element.get());
}

}  // namespace buckens::analysis
