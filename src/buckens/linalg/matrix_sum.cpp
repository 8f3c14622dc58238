// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/matrix_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/finite_matrix.h"
#include "buckens/linalg/node_blocks.h"

namespace buckens::linalg {

using Eigen::Index;

Index MatrixSum::size() const {
  if (terms_.empty()) return 0;
  const Term& first = terms_.front();
  return first.symmetric != nullptr ? first.symmetric->cols() : first.always_whole->cols();
}

bool MatrixSum::is_divisible() const {
  return std::all_of(terms_.begin(), terms_.end(),
                     [](const Term& term) { return term.symmetric != nullptr; });
}

bool MatrixSum::is_divided() const {
  return std::all_of(terms_.begin(), terms_.end(), [](const Term& term) {
    return term.symmetric != nullptr && term.symmetric->is_divided();
  });
}

SharedRowOrder MatrixSum::row_order() const {
  for (const Term& term : terms_) {
    SharedRowOrder order = term.symmetric->row_order();
    if (order) return order;
  }
  return nullptr;
}

std::vector<const DividedMatrix*> MatrixSum::divide() const { return divide(row_order()); }

std::vector<const DividedMatrix*> MatrixSum::divide(const SharedRowOrder& order) const {
  std::vector<const DividedMatrix*> out;
  for (const Term& term : terms_) out.push_back(&term.symmetric->divide(order));
  return out;
}

SymmetricMatrix MatrixSum::divided() const {
  std::vector<double> weights;
  for (const Term& term : terms_) weights.push_back(term.weight);
  return SymmetricMatrix(std::make_shared<const DividedMatrix>(divide(), weights));
}

namespace {

double inner_product_by_columns(const MatrixSum& A, const MatrixSum& B) {
  double sum = 0;
  std::vector<MatrixSum::Entry> of_A, of_B;
  for (Index column = 0; column < A.size(); ++column) {
    A.read_column(column, of_A);
    if (&A != &B) B.read_column(column, of_B);
    const std::vector<MatrixSum::Entry>& others = &A != &B ? of_B : of_A;
    auto other = others.begin();
    for (const MatrixSum::Entry& entry : of_A) {
      while (other != others.end() && other->row < entry.row) ++other;
      if (other == others.end()) break;
      if (other->row == entry.row) sum += entry.value * other->value;
    }
  }
  return sum;
}

}  // namespace

double inner_product(const MatrixSum& A, const MatrixSum& B) {
  if (!A.is_divided() || !B.is_divided()) return inner_product_by_columns(A, B);
  std::vector<const DividedMatrix*> terms = A.divide();
  std::vector<double> a, b(terms.size(), 0.0);
  for (const MatrixSum::Term& term : A.terms()) a.push_back(term.weight);
  for (const DividedMatrix* term : B.divide(A.row_order())) {
    terms.push_back(term);
    a.push_back(0.0);
  }
  for (const MatrixSum::Term& term : B.terms()) b.push_back(term.weight);
  return DividedMatrix::inner_product(terms, a, b);
}

/// Sums a column, from a row on, without forming what is by node or in blocks.
class MatrixSum::ColumnEntries {
 public:
  /// @param sums are replaced
  ColumnEntries(const MatrixSum& A, Index column, Index from, std::vector<Entry>& sums)
      : column_(column), from_(from), sums_(sums) {
    sums_.clear();
    if (A.terms_.empty()) return;
    // Most rows of other terms are among those of the largest.
    const auto largest = std::max_element(
        A.terms_.begin(), A.terms_.end(),
        [this](const Term& a, const Term& b) { return rows_about(a) < rows_about(b); });
    const bool is_first = largest == A.terms_.begin();
    const double weight = largest->weight;
    visit(*largest, [this, is_first, weight](Index row, double value) {
      sums_.push_back({static_cast<int>(row), is_first ? 0.0 + weight * value : 0.0});
    });
    for (auto term = A.terms_.begin() + (is_first ? 1 : 0); term != A.terms_.end(); ++term) {
      add(*term);
    }
  }

 private:
  /// In the column; blocks have all that other terms have, in general.
  Index rows_about(const Term& term) const {
    if (term.blocks() != nullptr) return std::numeric_limits<Index>::max();
    const SparseMatrix& A = term.nodes() != nullptr ? *term.nodes() : term.whole();
    const int* begin = A.outerIndexPtr() + (term.nodes() != nullptr ? column_ / 3 : column_);
    return begin[1] - begin[0];
  }

  template <class Visitor>
  void visit(const Term& term, Visitor&& visitor) const {
    if (term.blocks() != nullptr) {
      return term.blocks()->visit_column(column_, from_, visitor);
    }
    const bool is_by_node = term.nodes() != nullptr;
    const Index stride = is_by_node ? 3 : 1, offset = is_by_node ? column_ % 3 : 0;
    const SparseMatrix& A = is_by_node ? *term.nodes() : term.whole();
    for (SparseMatrix::InnerIterator it(A, column_ / stride); it; ++it) {
      const Index row = stride * it.row() + offset;
      if (row >= from_) visitor(row, it.value());
    }
  }

  void add(const Term& term) {
    Entry* at = sums_.data();
    const Entry* const end = at + sums_.size();
    const double weight = term.weight;
    std::vector<Entry> others;
    visit(term, [&](Index row, double value) {
      while (at != end && at->row < row) ++at;
      if (at != end && at->row == row) {
        at->value += weight * value;
      } else {
        others.push_back({static_cast<int>(row), 0.0 + weight * value});
      }
    });
    if (others.empty()) return;
    const auto known = static_cast<std::ptrdiff_t>(sums_.size());
    sums_.insert(sums_.end(), others.begin(), others.end());
    std::inplace_merge(sums_.begin(), sums_.begin() + known, sums_.end(),
                       [](const Entry& a, const Entry& b) { return a.row < b.row; });
  }

  Index column_, from_;
  std::vector<Entry>& sums_;
};

template <class Visitor>
void MatrixSum::visit_column(Index column, Index from, Visitor&& visit) const {
  std::vector<Entry> sums;
  const ColumnEntries read(*this, column, from, sums);
  for (const Entry& entry : sums) visit(entry.row, entry.value);
}

SparseMatrix MatrixSum::columns(Index first, Index count, Triangles which) const {
  const auto first_row = [which](Index column) { return which == Triangles::lower ? column : 0; };
  SparseMatrix out(size(), count);
  int* starts = out.outerIndexPtr();
  starts[0] = 0;
  for (Index k = 0; k < count; ++k) {
    int entries = 0;
    visit_column(first + k, first_row(first + k), [&entries](int, double) { ++entries; });
    starts[k + 1] = starts[k] + entries;
  }
  out.resizeNonZeros(starts[count]);
  Index place = 0;
  for (Index k = 0; k < count; ++k) {
    visit_column(first + k, first_row(first + k), [&](int row, double value) {
      out.innerIndexPtr()[place] = row;
      out.valuePtr()[place++] = value;
    });
  }
  return out;
}

void MatrixSum::read_column(Index column, std::vector<Entry>& entries) const {
  const ColumnEntries read(*this, column, 0, entries);
}

void MatrixSum::form_terms() const {
  for (const Term& term : terms_) {
    if (term.nodes() == nullptr && term.blocks() == nullptr) (void)term.whole();
  }
}

Vector MatrixSum::diagonal() const {
  Vector out = Vector::Zero(size());
  for (const Term& term : terms_) {
    out += term.weight * (term.symmetric != nullptr ? term.symmetric->diagonal()
                                                    : Vector(term.always_whole->diagonal()));
  }
  return out;
}

void MatrixSum::require_finite() const {
  for (const Term& term : terms_) {
    const bool was_asked = term.symmetric != nullptr && term.symmetric->is_divided();
    if (was_asked) continue;
    if (term.nodes() != nullptr && term.nodes()->coeffs().allFinite()) continue;
    if (term.blocks() != nullptr && term.blocks()->is_finite()) continue;
    linalg::require_finite(term.whole());
  }
  // Sums of finite entries may not be. If one beside the diagonal is not, and none on it, A is not
  // definite, which its factorisation finds.
  const Vector entries = diagonal();
  for (Index k = 0; k < entries.size(); ++k) {
    if (!std::isfinite(entries[k])) linalg::require_finite(columns(k, 1), static_cast<int>(k));
  }
}

}  // namespace buckens::linalg
