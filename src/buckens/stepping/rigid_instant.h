// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/multiplier_condensation.h"

namespace buckens::stepping {

/// An instant at which the stands of rigid rows are decided: of an iteration, or of a start.
struct RigidInstant {
  const std::vector<loads::RigidRow>& rows;
  const dynamics::SoftRows& soft;
  const std::vector<dynamics::BodyCompliance>& compliance;  ///< of the bodies [m/N]
  const std::vector<dynamics::BodyMotion>& motions;
  const std::vector<int>& rows_in_use;
  const dynamics::Circumstances& around;
  double t;
};

}  // namespace buckens::stepping
