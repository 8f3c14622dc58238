// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "buckens/base/characteristic.h"
#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Adds the slopes of a characteristic to those of a row. Where the force falls, the iteration goes
/// without: it converges by the inertia then.
inline void add_slopes(const std::optional<base::Characteristic>& curve, double x, double rate,
                       SoftRow& row) {
  if (!curve) return;
  const base::Characteristic::Slopes slopes = curve->slopes(x, rate);
  row.stiffness = std::max(0.0, row.stiffness + slopes.stiffness);
  row.damping = std::max(0.0, row.damping + slopes.damping);
}

}  // namespace buckens::loads
