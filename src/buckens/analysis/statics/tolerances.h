// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::analysis {

// When a model is at rest and closed: what assembly, continuation and descent agree on.
inline constexpr double kForceTolerance = 1e-9;  ///< of the largest force
inline constexpr double kClosed = 1e-12;         ///< of the model's length, about 1e4 roundings
/// Of the distance from the origin where that is more than the model's length: some ten roundings.
inline constexpr double kPositionRounding = 4e-15;
/// Of the model's length: a gap of dependent equations that is closed as far as anyone can tell.
inline constexpr double kDependentGap = 1e-9;

}  // namespace buckens::analysis
