// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::linalg {

enum class Triangles { both, lower };

/// A = Σ w_k A_k of symmetric matrices, both triangles stored, which is formed whole or some
/// columns at a time: what solves with A may need only a share of it at once.
class MatrixSum {
 public:
  MatrixSum() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): A itself is such a sum
  MatrixSum(const SparseMatrix& A) { add(1.0, A); }
  /// Adds w A. @param A of the size of the others, must outlive this object
  void add(double weight, const SparseMatrix& A) { terms_.push_back({weight, &A, nullptr}); }
  /// A matrix that may be divided among processes.
  void add(double weight, const SymmetricMatrix& A) { terms_.push_back({weight, nullptr, &A}); }

  /// 0 without terms.
  Eigen::Index size() const;
  /// Some columns, n×count, their rows ascending; takes no more memory than they do. Entries are
  /// summed in the order of the terms, so they have the bits of `w_1 * A_1 + w_2 * A_2 + …`.
  SparseMatrix columns(Eigen::Index first, Eigen::Index count,
                       Triangles which = Triangles::both) const;
  SparseMatrix whole() const { return columns(0, size()); }
  struct Entry {
    int row;
    double value;
  };
  /// The same entries of one column. Of several threads at once only if all terms are formed.
  /// @param entries are replaced
  void read_column(Eigen::Index column, std::vector<Entry>& entries) const;
  /// Has all terms in this process, so that threads may read columns. Those by node and in blocks
  /// stay as they are.
  void form_terms() const;
  Vector diagonal() const;
  /// @throws NumericalError if an entry of a term is not finite, or one on the diagonal of the sum
  void require_finite() const;

  struct Term {
    double weight;
    const SparseMatrix* always_whole;  // or null
    const SymmetricMatrix* symmetric;  // or null

    const SparseMatrix& whole() const { return symmetric ? symmetric->whole() : *always_whole; }
    /// A of one that is A ⊗ 1, or null.
    const SparseMatrix* nodes() const { return symmetric ? symmetric->nodes() : nullptr; }
    /// Null unless it is in blocks.
    const NodeBlocks* blocks() const { return symmetric ? symmetric->blocks() : nullptr; }
    Eigen::Index entries() const {
      return symmetric ? symmetric->nonZeros() : always_whole->nonZeros();
    }
  };
  const std::vector<Term>& terms() const { return terms_; }
  /// The only term, if there is one of weight 1 that is always whole; else null.
  const SparseMatrix* alone() const {
    return terms_.size() == 1 && terms_[0].weight == 1.0 ? terms_[0].always_whole : nullptr;
  }
  /// Whether all terms can be divided.
  bool is_divisible() const;
  /// Whether other processes have the rows of all terms.
  bool is_divided() const;
  /// All terms, which are divided from then on, in one order of rows. @pre is_divisible()
  std::vector<const DividedMatrix*> divide() const;
  std::vector<const DividedMatrix*> divide(const SharedRowOrder& order) const;
  /// That of the first term that has one. @pre is_divisible()
  SharedRowOrder row_order() const;
  /// The sum itself, which the processes that have its terms form. @pre is_divided()
  SymmetricMatrix divided() const;

 private:
  class ColumnEntries;

  /// Calls visit(row, value) for the entries of a column from a row on, rows ascending.
  template <class Visitor>
  void visit_column(Eigen::Index column, Eigen::Index from, Visitor&& visit) const;

  std::vector<Term> terms_;
};

/// The sum of the products of all entries of A and B, entry by entry, by the processes that have
/// both if is_divided() of both.
double inner_product(const MatrixSum& A, const MatrixSum& B);

}  // namespace buckens::linalg
