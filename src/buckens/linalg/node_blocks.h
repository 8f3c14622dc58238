// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A symmetric matrix of nodes, of which node j has the variables 3j, 3j + 1 and 3j + 2: of each
/// pair of nodes the 3×3 block is stored once, in two fifths of the memory of all entries with
/// their rows. Entries and pattern are those of the sparse matrix it is made of, and products have
/// the bits of Eigen's products with that.
class NodeBlocks {
 public:
  /// Below, memory does not matter, and entries are asked for now and then.
  static constexpr Eigen::Index kFewestVariables = 25;

  /// Null where A does not consist of nodes with entries of their own, is not symmetric to the last
  /// bit, or would take more than two thirds of its memory.
  /// @param A compressed, both triangles
  static std::shared_ptr<const NodeBlocks> of(const SparseMatrix& A, TaskPool* pool = nullptr);

  Eigen::Index size() const { return 3 * num_nodes(); }
  /// Of both triangles.
  Eigen::Index nonZeros() const { return entries_; }
  double bytes() const;
  /// 0 where there is no entry.
  double coeff(Eigen::Index row, Eigen::Index column) const;
  Vector diagonal() const;
  /// Of Frobenius.
  double norm() const;
  /// See SymmetricMatrix.
  std::array<std::uint64_t, 2> content() const;
  bool is_finite() const;
  /// The same bits.
  bool operator==(const NodeBlocks& other) const = default;
  /// All entries, compressed.
  SparseMatrix whole() const;

  /// y = A x, one pass over the blocks.
  void multiply(const double* x, double* y) const;
  /// y ← y + A x
  void add_product(const double* x, double* y) const;

  class Column;
  /// Calls visit(row, value) for the entries of a column from row `from` on, rows ascending.
  template <class Visitor>
  void visit_column(Eigen::Index column, Eigen::Index from, Visitor&& visit) const;
  /// Whether the three columns of each node have entries in the same rows.
  bool has_whole_blocks() const { return masks_.empty(); }
  /// The nodes of the rows in which the columns of a node have entries, ascending.
  void read_nodes(int node, std::vector<int>& nodes) const;

 private:
  /// A block left of the diagonal, whose mirror image is stored.
  struct Left {
    int column;    // node
    int position;  // of the mirror image
    bool operator==(const Left&) const = default;
  };
  using Mask = std::uint16_t;  // bit 3r + c: there is an entry in row r, column c
  static constexpr Mask kWhole = 0x1ff;

  Eigen::Index num_nodes() const { return static_cast<Eigen::Index>(begin_.size()) - 1; }
  Mask mask(int position) const {
    return masks_.empty() ? kWhole : masks_[static_cast<std::size_t>(position)];
  }
  /// @return false if they cannot be stored
  bool take_rows(const SparseMatrix& A);
  void take_entries(const SparseMatrix& A, TaskPool* pool);
  void list_left();
  /// @param begin,end columns that are compared
  bool is_mirrored(const SparseMatrix& A, int begin, int end) const;

  // Of each column of blocks those from the diagonal down, rows ascending.
  std::vector<int> begin_{0};
  std::vector<int> rows_;  // nodes
  // Nine numbers per block, row by row.
  std::vector<double> values_;
  std::vector<Mask> masks_;  // empty if all blocks are whole
  // Of each row of blocks those left of the diagonal, columns ascending.
  std::vector<int> left_begin_;
  std::vector<Left> left_;
  Eigen::Index entries_ = 0;
};

/// Goes through the entries of a column, rows ascending, as SparseMatrix::InnerIterator does.
class NodeBlocks::Column {
 public:
  Column() = default;
  /// @param from first row that counts
  Column(const NodeBlocks& A, Eigen::Index column, Eigen::Index from = 0)
      : A_(&A), component_(static_cast<int>(column % 3)) {
    const auto node = static_cast<std::size_t>(column / 3);
    left_ = A.left_begin_[node];
    left_end_ = A.left_begin_[node + 1];
    if (from >= column / 3 * 3) left_ = left_end_;
    own_ = A.begin_[node];
    own_end_ = A.begin_[node + 1];
    enter();
    while (*this && row() < from) ++*this;
  }
  explicit operator bool() const { return present_ != 0; }
  Eigen::Index row() const { return row_ + std::countr_zero(present_); }
  double value() const { return value_[stride_ * std::countr_zero(present_)]; }
  Column& operator++() {
    present_ &= present_ - 1U;
    if (present_ == 0) enter();
    return *this;
  }

 private:
  /// The next block with an entry, if there is one.
  void enter() {
    while (present_ == 0) {
      if (left_ != left_end_) {
        const Left& at = A_->left_[static_cast<std::size_t>(left_++)];
        take(at.position, at.column, 3 * component_, 1);
        present_ = A_->mask(at.position) >> (3 * component_) & 7U;
      } else if (own_ != own_end_) {
        take(own_, A_->rows_[static_cast<std::size_t>(own_)], component_, 3);
        const unsigned column = static_cast<unsigned>(A_->mask(own_++)) >> component_;
        present_ = (column & 1U) | (column >> 2U & 2U) | (column >> 4U & 4U);
      } else {
        return;
      }
    }
  }
  void take(int position, int node, int first, int stride) {
    value_ = A_->values_.data() + 9 * static_cast<std::ptrdiff_t>(position) + first;
    row_ = 3 * node;
    stride_ = stride;
  }

  const NodeBlocks* A_ = nullptr;
  int component_ = 0;
  int left_ = 0, left_end_ = 0, own_ = 0, own_end_ = 0;
  // Of the block it is in: its entries in the column, and which of them are left.
  const double* value_ = nullptr;
  int row_ = 0, stride_ = 0;
  unsigned present_ = 0;
};

template <class Visitor>
void NodeBlocks::visit_column(Eigen::Index column, Eigen::Index from, Visitor&& visit) const {
  if (!has_whole_blocks()) {
    for (Column it(*this, column, from); it; ++it) visit(it.row(), it.value());
    return;
  }
  const auto node = static_cast<std::size_t>(column / 3);
  const auto visit_block = [&](Eigen::Index row, const double* values, int stride) {
    for (int r = 0; r < 3; ++r) {
      if (row + r >= from) visit(row + r, values[stride * r]);
    }
  };
  const double* of_column = values_.data() + column % 3;
  const double* of_row = values_.data() + column % 3 * 3;
  for (int k = left_begin_[node]; k < left_begin_[node + 1]; ++k) {
    const Left& at = left_[static_cast<std::size_t>(k)];
    visit_block(3 * Eigen::Index{at.column}, of_row + 9 * static_cast<std::ptrdiff_t>(at.position),
                1);
  }
  for (int k = begin_[node]; k < begin_[node + 1]; ++k) {
    visit_block(3 * Eigen::Index{rows_[static_cast<std::size_t>(k)]},
                of_column + 9 * static_cast<std::ptrdiff_t>(k), 3);
  }
}

}  // namespace buckens::linalg
