// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/dimension.h"

namespace buckens::base {

inline constexpr Dimension kAngularAcceleration{0, 0, -2, 1};
inline constexpr Dimension kPower{2, 1, -3, 0};

}  // namespace buckens::base
