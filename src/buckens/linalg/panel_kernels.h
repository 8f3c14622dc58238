// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/linalg/simd_level.h"

namespace buckens::linalg {

/// Rows of a block of a panel: one cache line of doubles.
inline constexpr int kPanelRows = 8;
/// Largest number of columns of a panel.
inline constexpr int kPanelColumns = 128;
/// Largest number of right-hand sides in one pass.
inline constexpr int kMostSides = 32;

/// Up to kPanelColumns columns of a Cholesky factor in the order a solve reads them.
///
/// `values` holds blocks of eight rows, each column by column, 64-byte aligned and contiguous:
/// first the inverse of the triangle on the diagonal (block b holds columns 0 … 8b+7 only), then
/// the rows below it. Missing rows of a last block are zero. A forward solve reads all of it
/// upwards in memory, a backward solve downwards.
struct Panel {
  const double* values;
  const int* rows;  ///< places of the rows below, kPanelRows per block
  int first;        ///< place of the first column; the others follow
  int columns;
  int row_blocks;  ///< blocks below the triangle

  int triangle_blocks() const { return (columns + kPanelRows - 1) / kPanelRows; }
  /// Columns that block `b` of the triangle holds.
  int triangle_columns(int b) const {
    const int end = kPanelRows * (b + 1);
    return end < columns ? end : columns;
  }
  /// Columns of eight values in all blocks.
  std::ptrdiff_t num_lines() const {
    const std::ptrdiff_t last = triangle_blocks() - 1;
    return kPanelRows * (last * (last + 1) / 2) + columns +
           static_cast<std::ptrdiff_t>(row_blocks) * columns;
  }
};

/// Solves with consecutive panels for `sides` right-hand sides. Right-hand sides are interleaved:
/// `x` holds `sides` numbers per place; `sides` is 1 or a multiple of side_multiple(). If there are
/// several, no bit of one depends on how many stand beside it.
struct PanelKernels {
  /// For every panel upwards: y = T x at its places, x −= L y at the rows below.
  void (*forward)(const Panel* begin, const Panel* end, double* x, int sides);
  /// For every panel downwards: x = Tᵀ (x − Lᵀ x at the rows below).
  void (*backward)(const Panel* begin, const Panel* end, double* x, int sides);

  // The same in pieces, of which several threads may take some each: neither the division of rows
  // nor that of columns changes a bit.

  /// y = T x at the places of one panel.
  void (*forward_triangle)(const Panel& panel, double* x, int sides);
  /// x −= L y at the rows of the row blocks begin … end − 1.
  void (*forward_rows)(const Panel& panel, int begin, int end, double* x, int sides);
  /// x −= Lᵀ x at the rows below, for the columns begin … end − 1.
  void (*backward_rows)(const Panel& panel, int begin, int end, double* x, int sides);
  /// x = Tᵀ x at the places of one panel.
  void (*backward_triangle)(const Panel& panel, double* x, int sides);
};

/// Several right-hand sides are padded to a multiple of this.
constexpr int side_multiple() { return 4; }

/// Kernels of one level, which the processor must support.
const PanelKernels& panel_kernels(SimdLevel level);

// One source each, compiled for its instruction set.
extern const PanelKernels kPortablePanelKernels;
#if defined(__x86_64__)
extern const PanelKernels kAvx2PanelKernels;
extern const PanelKernels kAvx512PanelKernels;
#endif

}  // namespace buckens::linalg
