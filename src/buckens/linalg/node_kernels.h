// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/linalg/simd_level.h"

namespace buckens::linalg {

/// View of a symmetric matrix over nodes, whose entries act alike on the three variables of each:
/// node j has the variables 3j, 3j + 1, 3j + 2. Compressed columns, rows ascending.
struct NodeMatrix {
  const double* values = nullptr;
  const int* rows = nullptr;
  const int* begin = nullptr;  ///< of the columns, `nodes` + 1
  int nodes = 0;
};

/// Sums of 3×3 products over nodes, by columns of four numbers of which the last is unused.
struct NodeSums {
  static constexpr int kColumns = 9;
  alignas(64) double value[4 * kColumns] = {};
};

/// Loops over some nodes of a body, `first` … `first + count − 1`; vectors begin at node 0. Neither
/// the division of nodes nor the number of calls changes a bit of what is written per node.
struct NodeKernels {
  /// y = M x.
  void (*multiply)(const NodeMatrix& M, int first, int count, const double* x, double* y);
  /// Adds (M d) dᵀ, (M d) vᵀ and (M d) aᵀ to the columns 0–2, 3–5 and 6–8 of `sums`, and, unless
  /// `load` is null, A M d + B M v to it. @param weights A and B, columns of four numbers each
  void (*couple)(const NodeMatrix& M, int first, int count, const double* const* d_v_a,
                 const double* weights, double* load, NodeSums& sums);
  /// Adds x pᵀ to the first four columns of `sums`. @param places p, four numbers per node
  void (*moments)(const double* places, int first, int count, const double* x, NodeSums& sums);
  /// y −= T p. @param motion T, four columns of four numbers
  void (*subtract)(const double* places, int first, int count, const double* motion, double* y);
  /// y += Σ weight × column, over rows instead of nodes. @param stride between columns
  void (*add_columns)(const double* columns, std::ptrdiff_t stride, int num_columns,
                      const double* weights, std::ptrdiff_t rows, double* y);
};

/// Kernels of one level, which the processor must support.
const NodeKernels& node_kernels(SimdLevel level = best_simd_level());

// One source each, compiled for its instruction set.
extern const NodeKernels kPortableNodeKernels;
#if defined(__x86_64__)
extern const NodeKernels kAvx2NodeKernels;
extern const NodeKernels kAvx512NodeKernels;
#endif

}  // namespace buckens::linalg
