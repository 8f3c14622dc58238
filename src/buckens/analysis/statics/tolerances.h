// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::analysis {

// Tolerances for a model at rest and closed, shared by assembly, continuation and descent.
inline constexpr double kForceTolerance = 1e-9;  ///< of the largest force
inline constexpr double kClosed = 1e-12;         ///< of the model's length, about 1e4 roundings
/// Of the distance from the origin if that exceeds the model's length: about ten roundings.
inline constexpr double kPositionRounding = 4e-15;
/// Of the model's length: a gap of dependent equations that counts as closed.
inline constexpr double kDependentGap = 1e-9;

/// Of lengths [share of the model's length] and angles [rad]: forces are differenced over twice of
/// it, so that springs of contacts that are open by less are felt.
inline constexpr double kDifference = 1e-5;

}  // namespace buckens::analysis
