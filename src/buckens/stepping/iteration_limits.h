// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::stepping {

// Convergence is linear with the frozen matrix of the step: what the next iteration would change is
// known from the last two. It has to be this much smaller than what the tolerance admits.
inline constexpr double kForeseen = 0.01;
// What rounding of positions leaves open, relative to the model's length, or to the distance from
// the origin where that is more.
inline constexpr double kRounding = 1e-15;
// A change that no longer falls is rounding if it is below these shares of the same lengths.
inline constexpr double kStalled = 1e-11;
inline constexpr double kStalledFarAway = 1e-14;
// Rows whose pivots have fallen below this hold their bodies by a short lever, the root of the
// pivot; rounding moves these bodies by its inverse more.
inline constexpr double kWeaklyHeld = 1e-6;
inline constexpr double kSlow = 0.3;  // no foresight where the iteration converges slower than this

}  // namespace buckens::stepping
