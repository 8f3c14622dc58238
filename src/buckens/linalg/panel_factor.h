// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/panel_kernels.h"
#include "buckens/linalg/streaming_memory.h"
#include "buckens/linalg/supernode_tree.h"
#include "buckens/linalg/supernodes.h"

namespace buckens::linalg {

/// A Cholesky factor laid out for repeated solves, which are limited by memory bandwidth: a forward
/// and a backward pass read it once each, in order, without gaps.
///
/// Columns lie in panels of at most 128, rows in blocks of one cache line, triangles on the
/// diagonal inverted, all contiguous on huge pages. The factorisation (multifrontal.h) writes into
/// them. Two threads take whole subtrees each; contributions to the rows above both are kept
/// separate and summed in a fixed order, so the result does not depend on the number of threads.
class PanelFactor {
 public:
  /// Intermediate results of solves, kept between calls. One for each solve at a time.
  class Workspace {
   public:
    StreamingMemory values;
  };

  /// Factorises A.
  /// @param tree of A @param pool may share the work; changes no bit
  /// @param begin called with bytes() before the work begins
  /// @throws IndefiniteMatrix if A is not positive definite
  /// @throws std::bad_alloc
  PanelFactor(const SparseMatrix& A, const SupernodeTree& tree, SimdLevel level, TaskPool* pool,
              const std::function<void(double bytes)>& begin = {});

  /// Takes over what CHOLMOD has computed: the reference for tests and benchmarks.
  explicit PanelFactor(const Supernodes& source, SimdLevel level = best_simd_level());

  Eigen::Index size() const { return size_; }
  /// Bytes that each of the two passes reads.
  double bytes() const { return static_cast<double>(values_.size()) * sizeof(double); }
  /// Parts that can be solved at the same time, 1 or 2.
  int num_groups() const { return static_cast<int>(groups_.size()); }

  /// X ← A⁻¹ B, column by column. Allocates only where the workspace is too small.
  /// @param B,X column-major, may be the same. @param stride from column to column
  void solve(const double* B, double* X, Eigen::Index columns, Eigen::Index stride, Workspace& work,
             TaskPool* pool) const;
  /// x ← A⁻¹ x for vectors anywhere in memory.
  void solve_in_place(std::span<double* const> vectors, Workspace& work, TaskPool* pool) const;

 private:
  /// Places of one group: own columns, a copy of the top's, one for missing rows.
  struct Group {
    int first = 0;
    int columns = 0;
    int panels_begin = 0, panels_end = 0;
  };
  class Layout;
  friend class PanelFile;
  explicit PanelFactor(SimdLevel level) : kernels_(&panel_kernels(level)) {}

  void solve_some(const double* const* B, double* const* X, int columns, Workspace& work,
                  TaskPool* pool) const;
  void gather(int group, const double* const* B, int columns, int sides, double* x) const;
  void scatter(int group, const double* x, int sides, int columns, double* const* X) const;
  void solve_top(double* x, int sides) const;
  int top_place(int group) const;

  Eigen::Index size_ = 0;
  const PanelKernels* kernels_;
  StreamingMemory values_;
  std::vector<int> rows_;
  std::vector<Panel> panels_;  // by group, the top last
  std::vector<Group> groups_;
  int top_columns_ = 0;
  int top_begin_ = 0;        // first panel of the top
  int num_places_ = 0;       // of all groups
  std::vector<int> origin_;  // row of A per place, −1 where there is none
};

}  // namespace buckens::linalg
