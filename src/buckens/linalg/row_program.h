// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "buckens/linalg/node_kernels.h"

namespace buckens::linalg {

/// What processes do with their rows of vectors (RowProgram says it, RowWorker does it). Each task
/// is followed by what is listed here, vectors by their numbers; sums are of the rows of a process.
enum class RowTask : std::int32_t {
  drop,           ///< y: gives its memory back
  combine,        ///< y, adds, count, (weight, x)…: y ← [y +] Σ weight x
  multiply_mass,  ///< y, x: y ← (Ms ⊗ 1) x
  couple,         ///< load or −1, d, ḋ, d̈, 24 weights: NodeKernels::couple; all of `NodeSums`
  moments,        ///< x: NodeKernels::moments of first moments of mass; 16 sums
  subtract,       ///< y, 16 numbers T: NodeKernels::subtract of positions
  row_products,   ///< count, x…: N x; as many sums per x as N has rows
  compare,        ///< x, x before, weights: kCompared sums
  total           ///< count, x…: the sum of all numbers; not finite if one of them is not
};

/// Sums of a comparison: Σ weight (x − before)², Σ weight x², and the largest weight |x − before|.
constexpr int kCompared = 3;
constexpr int kMomentSums = 16;
constexpr int kCoupleSums = 4 * NodeSums::kColumns;
constexpr int kCoupleWeights = 24;
constexpr int kMotionNumbers = 16;

}  // namespace buckens::linalg
