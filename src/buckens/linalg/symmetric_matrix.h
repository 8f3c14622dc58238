// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

class DividedMatrix;
class NodeBlocks;

/// A sparse symmetric matrix, both triangles stored, such as M, K and C of a body.
///
/// Where several processes share the work it may be divided among those other than the first
/// (ranks.h): make_large_factor() does so with the terms of a sum. That changes where its
/// numbers are and not what they are, so it is possible with constant objects, too. Products then
/// go over those processes; whole() brings it back.
///
/// In a process by itself, mass matrices of solids act alike on the three variables of each node
/// and store one number for the three (by_node()). Their stiffness stores each block of two nodes
/// once (in_blocks()). Others are whole. Products have the bits of Eigen's, except for those by
/// node.
class SymmetricMatrix {
 public:
  SymmetricMatrix() = default;
  // NOLINTBEGIN(google-explicit-constructor): they are one
  SymmetricMatrix(const SparseMatrix& A) : size_(A.rows()), here_(A) {}
  SymmetricMatrix(SparseMatrix&& A) : size_(A.rows()) { here_.swap(A); }
  // NOLINTEND(google-explicit-constructor)
  /// One that is divided from the beginning.
  explicit SymmetricMatrix(std::shared_ptr<const DividedMatrix> rows);
  /// A ⊗ 1: node j has the variables 3j, 3j + 1 and 3j + 2. Reads `nodes`, as others may.
  /// @param nodes A, compressed, with entries
  static SymmetricMatrix by_node(std::shared_ptr<const SparseMatrix> nodes);
  /// In blocks of nodes where that is possible and takes less memory (NodeBlocks::of()), from a
  /// size on at which memory matters; else whole. Empties A.
  static SymmetricMatrix in_blocks(SparseMatrix&& A, TaskPool* pool = nullptr);
  SymmetricMatrix(const SymmetricMatrix&) = default;
  SymmetricMatrix& operator=(const SymmetricMatrix&) = default;
  // Eigen's own moves copy.
  SymmetricMatrix(SymmetricMatrix&& from) noexcept { *this = std::move(from); }
  SymmetricMatrix& operator=(SymmetricMatrix&& from) noexcept {
    size_ = from.size_;
    here_.swap(from.here_);
    nodes_.swap(from.nodes_);
    blocks_.swap(from.blocks_);
    divided_.swap(from.divided_);
    order_.swap(from.order_);
    return *this;
  }
  ~SymmetricMatrix() = default;

  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  Eigen::Index nonZeros() const;
  Vector diagonal() const;
  /// Of each column the entries of so many rows from the diagonal on, column after column, without
  /// bringing anything else back. @pre a length for each column, none beyond the last row
  Vector near_diagonal(std::span<const int> lengths) const;
  /// Of Frobenius.
  double norm() const;

  /// In this process, from now on. The reference ends with the next divide(). Not from several
  /// threads at once, unless is_formed().
  const SparseMatrix& whole() const;
  /// The same entries for those who need them once: nothing stays that was not formed before.
  SparseMatrix copied() const;
  /// A of A ⊗ 1, or null: products need nothing else, and entries follow from it.
  const SparseMatrix* nodes() const { return nodes_.get(); }
  /// Null unless it is in blocks: products and columns need nothing else.
  const NodeBlocks* blocks() const { return blocks_.get(); }
  /// Whether the entries themselves are in this process.
  bool is_formed() const {
    return !is_divided() && ((nodes_ == nullptr && blocks_ == nullptr) || here_.nonZeros() > 0);
  }
  // NOLINTNEXTLINE(google-explicit-constructor)
  operator const SparseMatrix&() const { return whole(); }

  /// A X, column by column where A is not whole.
  template <class Derived>
  auto operator*(const Eigen::MatrixBase<Derived>& X) const {
    Eigen::Matrix<double, Eigen::Dynamic, Derived::ColsAtCompileTime> out(rows(), X.cols());
    if (is_divided() || nodes_ != nullptr || blocks_ != nullptr) {
      const Eigen::Matrix<double, Eigen::Dynamic, Derived::ColsAtCompileTime> columns = X;
      for (Eigen::Index k = 0; k < out.cols(); ++k) {
        multiply(columns.data() + k * columns.rows(), out.data() + k * out.rows());
      }
    } else {
      out.noalias() = here_ * X.derived();
    }
    return out;
  }

  /// y ← y + A x
  void add_product(const Vector& x, Vector& y) const;

  /// Whether they have the same bits.
  bool operator==(const SymmetricMatrix& other) const;
  /// Hash of pattern and values.
  std::array<std::uint64_t, 2> content() const;

  /// Gives the rows to the other processes, unless they have them; a matrix by node or in blocks
  /// is one like others from then on. @pre Ranks::count() > 1
  /// @throws NumericalError if memory is too small
  const DividedMatrix& divide() const { return divide(row_order()); }
  /// In a given order of rows, which all terms of a sum have in common.
  const DividedMatrix& divide(const SharedRowOrder& order) const;
  /// That of the processes that have the rows or had them last; null before.
  SharedRowOrder row_order() const;
  /// Has the rows of an equal matrix from now on, where other processes have those.
  void share(const SymmetricMatrix& equal) const;
  bool is_divided() const { return divided_ != nullptr; }

 private:
  void multiply(const double* x, double* y) const;
  void drop() const;

  Eigen::Index size_ = 0;
  mutable SparseMatrix here_;  // empty unless is_formed()
  // Of one that is not divided, or null.
  mutable std::shared_ptr<const SparseMatrix> nodes_;
  mutable std::shared_ptr<const NodeBlocks> blocks_;
  mutable std::shared_ptr<const DividedMatrix> divided_;
  mutable SharedRowOrder order_;  // of one that was divided
};

/// w A X. Where A is whole it has the bits of Eigen's `w * (A * X)`, which are those of (w A) X.
Matrix weighted_product(double weight, const SymmetricMatrix& A, const Matrix& X);

/// y = A x, of vectors of its length.
struct MatrixProduct {
  const SymmetricMatrix* A;
  const Vector* x;
  Vector* y;
};
/// Several products, by one order to other processes where matrices are divided. Allocates nothing
/// in a process by itself once all y have their size.
/// @param pool forms several at the same time, or null
void multiply(std::initializer_list<MatrixProduct> products, TaskPool* pool = nullptr);

}  // namespace buckens::linalg
