// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace buckens::analysis {

/// Radians of one turn: circular frequency [rad/s] over frequency [Hz].
inline constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace buckens::analysis
