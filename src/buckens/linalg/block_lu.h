// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// LU factors of a sparse matrix of small dense blocks, as joints along chains and trees
/// produce.
///
/// The pattern of blocks is symmetric and never changes; the values need not be symmetric. Blocks
/// are eliminated in minimum-degree order, found once: a chain or a tree of blocks has no fill-in,
/// so that a factorisation and a solve cost O(number of blocks). Pivots are taken from the
/// diagonal, which suffices near a positive definite matrix. Elsewhere pivot_ratio() shows that it
/// did not, and the caller switches to a general factor (SparseLu).
///
/// Values are stored in the order in which the elimination reads them. Blocks of different sizes
/// are padded to the largest with the identity, unless that takes more than twice the memory.
class BlockLu {
 public:
  static constexpr int kLargestBlock = 6;

  /// @param sizes rows of each diagonal block, 1 … kLargestBlock
  /// @param couples pairs of blocks with entries off the diagonal; any order, repetitions allowed
  /// @param rows where the rows of the blocks, one after the other, stand in vectors and for
  /// diagonal(); empty: in this order
  BlockLu(std::vector<int> sizes, const std::vector<std::pair<int, int>>& couples,
          std::vector<int> rows = {});

  /// Enters all that another matrix with the same pattern has, with the blocks that are alone
  /// there.
  void take_values(const BlockLu& from);
  /// Where a block of the pattern is stored. @param i,j equal, or a pair of the constructor
  int place(int i, int j) const;
  /// Starts a new matrix: all values become zero.
  void clear();
  /// Entries of a block by columns, stride() rows each, until factorise() is called.
  double* block(int place) { return &values_[places_[static_cast<std::size_t>(place)].first]; }
  int stride(int place) const { return places_[static_cast<std::size_t>(place)].stride; }
  /// A diagonal entry of the matrix.
  double& diagonal(int row);
  /// Says which blocks have nothing off their diagonal block in the matrices to come, neither by
  /// row nor by column: they cost nothing, and the result is the same.
  /// After clear(), or with no fewer of them coupled than before.
  /// @param blocks one entry per block, not zero: alone; empty: none
  void set_alone(const std::vector<char>& blocks);

  /// Factorises what was entered. @return false if a pivot is not positive or not a number
  bool factorise();
  /// Smallest pivot relative to the original diagonal entry, 0 … 1.
  double pivot_ratio() const { return pivot_ratio_; }
  /// x ← A⁻¹ x with the last factorisation. Allocates nothing.
  void solve_in_place(Vector& x) const;

  int size() const { return static_cast<int>(rows_.size()); }
  /// Numbers stored, including padding.
  std::size_t num_entries() const { return values_.size(); }

 private:
  struct Place {
    int row, column;    // blocks
    std::size_t first;  // of its values
    int stride;         // rows as stored
  };
  /// One step of the elimination.
  struct Pivot {
    int block;
    int stored;                // rows as stored
    std::size_t first_stored;  // of its rows in x_ and inverse_
    std::size_t diagonal;      // first value of the diagonal block
    std::size_t first_neighbour, end_neighbour;
    bool is_alone = false;
  };
  /// A remaining block coupled with the pivot. Those of one pivot are sorted by their own order of
  /// elimination.
  struct Neighbour {
    int stored;
    int turn;  // its own in pivots_
    std::size_t first_stored;
    std::size_t lower, upper;  // first values of (neighbour, pivot) and (pivot, neighbour)
    bool is_alone = false;
  };

  /// Calls f(place) for all blocks of which neither row nor column is alone.
  template <class F>
  void for_coupled(F&& f) const;
  std::size_t size_of(const Place& place) const;

  void order(const std::vector<std::pair<int, int>>& couples);
  void lay_out();
  void place_rows();
  template <int R>
  bool eliminate();
  template <int R>
  void update_later(const Pivot& pivot);
  template <int R>
  void substitute() const;
  template <int R>
  void substitute_backward() const;

  std::vector<int> sizes_;
  std::vector<int> rows_;                  // in vectors, block by block
  std::vector<std::size_t> stored_place_;  // of each of them in x_
  std::vector<std::size_t> diagonal_;      // entry of each row of vectors in values_
  std::vector<std::size_t> first_stored_;
  std::vector<Place> places_;
  std::vector<std::vector<std::pair<int, int>>> by_row_;  // per block: (column, place), ascending
  int uniform_ = 0;                        // rows of every block as stored, 0 if each has its own
  std::vector<int> sequence_;              // blocks in order of elimination
  std::vector<std::vector<int>> coupled_;  // neighbours of each at that time
  std::vector<Pivot> pivots_;
  std::vector<Neighbour> neighbours_;
  std::vector<double> values_;     // zero where a block is alone, but for its diagonal block
  std::vector<char> alone_;        // as set_alone() has it
  bool has_alone_ = false;         // any of them
  std::vector<double> inverse_;    // of pivots
  mutable std::vector<double> x_;  // of a solve, as stored
  double pivot_ratio_ = 1;
};

}  // namespace buckens::linalg
