// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "buckens/linalg/node_kernels.h"

namespace buckens::linalg {

/// What processes do with their rows of vectors (RowProgram says it, RowWorker does it). Each task
/// is followed by what is listed here, vectors by their numbers; sums are of the rows of a process.
enum class RowTask : std::int32_t {
  space,          ///< of the vectors from here on; the first task of a program
  drop,           ///< y: gives its memory back
  combine,        ///< y, adds, count, (weight, x)…: y ← [y +] Σ weight x
  multiply_mass,  ///< y, x: y ← (Ms ⊗ 1) x
  multiply,       ///< y, x, A: y ← A x, A the number of a divided matrix
  couple,         ///< load or −1, d, ḋ, d̈, 24 weights: RowInertia::couple; all of `NodeSums`
  moments,        ///< x: RowInertia::add_moments; kMomentSums
  subtract,       ///< y, kMotionNumbers: RowInertia::subtract
  resultants,     ///< f: RowInertia::add_resultants; kMomentSums
  subtract_load,  ///< f, kMotionNumbers: RowInertia::subtract_load
  add_row_loads,  ///< f, as many weights as N has rows: f ← f + Nᵀ weights
  row_products,   ///< count, x…: N x; as many sums per x as N has rows
  pick,           ///< x, count, rows: x of these rows of the body; zeros of rows of others
  compare,        ///< x, x before, weights, weights of the largest: kCompared sums
  total,          ///< count, x…: the sum of all numbers; not finite if one of them is not
  square,         ///< x: Σ x²
  inner_product,  ///< x, y: Σ x y
  largest_norm,   ///< x, A, is new, count, rows, shape of F, F: largest ‖F y‖² of runs of A x
  scale,          ///< y, x, w, divides: y ← w x or x/w, row by row
  // Of kept pairs (c, x), by their number, the first of them and how many:
  pair_products,    ///< …, r: cᵢᵀ r, as many sums as pairs
  subtract_loads,   ///< …, r, weights: r ← r − Σ weight cᵢ, rounded to single precision
  combine_answers,  ///< …, y, adds, weights: y ← [y +] Σ weight xᵢ
  put_pair          ///< …, factor, load, answer: one pair becomes factor × both
};

/// Sums of a comparison: Σ weight (x − before)², Σ weight x², and the largest weight |x − before|.
constexpr int kCompared = 3;
constexpr int kMomentSums = 16;
/// Where those of patterns begin, of a body whose moments are taken variable by variable.
constexpr int kPatternSums = 6;
constexpr int kCoupleSums = 4 * NodeSums::kColumns;
constexpr int kCoupleWeights = 24;
constexpr int kMotionNumbers = 16;

}  // namespace buckens::linalg
