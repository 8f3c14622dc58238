// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_sum.h"
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
/// them. Threads take whole subtrees each (subtree_groups.h); contributions to the rows above two
/// of them are kept separate and added in a fixed order. Panels above are shared by rows in the
/// forward pass, by columns in the backward pass. So no bit depends on the number of threads.
class PanelFactor {
 public:
  /// Intermediate results of solves, kept between calls. One for each solve at a time.
  class Workspace {
   public:
    Workspace();
    ~Workspace();
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;

   private:
    friend class PanelFactor;
    struct Meetings;
    StreamingMemory values_;
    std::unique_ptr<Meetings> meetings_;  // of the threads of a group
  };

  /// Factorises A, whose terms are formed.
  /// @param tree of A @param pool may share the work; changes no bit
  /// @param begin called with bytes() before the work begins
  /// @throws IndefiniteMatrix if A is not positive definite
  /// @throws std::bad_alloc
  PanelFactor(const MatrixSum& A, const SupernodeTree& tree, SimdLevel level, TaskPool* pool,
              const std::function<void(double bytes)>& begin = {});

  /// Takes over what CHOLMOD has computed: the reference for tests and benchmarks.
  explicit PanelFactor(const Supernodes& source, SimdLevel level = best_simd_level());

  Eigen::Index size() const { return size_; }
  /// Bytes that each of the two passes reads.
  double bytes() const { return static_cast<double>(values_.size()) * sizeof(double); }
  /// Parts that can be solved at the same time.
  int num_parts() const { return (static_cast<int>(groups_.size()) + 1) / 2; }
  /// Share of bytes() that the busiest of several threads reads.
  double busiest_share(int threads) const;

  /// X ← A⁻¹ B, column by column. Allocates only where the workspace is too small.
  /// @param B,X column-major, may be the same. @param stride from column to column
  void solve(const double* B, double* X, Eigen::Index columns, Eigen::Index stride, Workspace& work,
             TaskPool* pool) const;
  /// x ← A⁻¹ x for vectors anywhere in memory.
  void solve_in_place(std::span<double* const> vectors, Workspace& work, TaskPool* pool) const;

 private:
  static constexpr int kNone = -1;

  /// Places of one group: own columns, copies of those of all groups above it, nearest first, and
  /// one for missing rows. A group with others below it has its places among those of the first of
  /// them, of which they are the end.
  struct Group {
    int first = 0;
    int columns = 0;
    int above = 0;
    int panels_begin = 0, panels_end = 0;
    int parent = kNone;
    int below[2] = {kNone, kNone};

    int size() const { return columns + above; }
    bool is_leaf() const { return below[0] == kNone; }
  };
  class Layout;
  struct Solve;
  struct Team;
  friend class PanelFile;
  explicit PanelFactor(SimdLevel level) : kernels_(&panel_kernels(level)) {}

  const Group& group(int g) const { return groups_[static_cast<std::size_t>(g)]; }
  int last_group() const { return static_cast<int>(groups_.size()) - 1; }

  // panel_solve.cpp
  void solve_some(const double* const* B, double* const* X, int columns, Workspace& work,
                  TaskPool* pool) const;
  void forward(const Solve& solve, int g, const Team& team) const;
  void backward(const Solve& solve, int g, const Team& team) const;
  void forward_panels(const Solve& solve, int g, const Team& team) const;
  void backward_panels(const Solve& solve, int g, const Team& team) const;
  void gather(const Solve& solve, int g) const;
  void scatter(const Solve& solve, int g) const;

  Eigen::Index size_ = 0;
  const PanelKernels* kernels_;
  StreamingMemory values_;
  std::vector<int> rows_;
  std::vector<Panel> panels_;  // by group
  std::vector<Group> groups_;  // children before their parents
  int num_places_ = 0;         // of all groups
  std::vector<int> origin_;    // row of A per place, −1 where there is none
};

}  // namespace buckens::linalg
