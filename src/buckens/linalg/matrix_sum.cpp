// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/matrix_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/finite_matrix.h"

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

double inner_product(const MatrixSum& A, const MatrixSum& B) {
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

/// Goes through a column of a term, of one that is given by node without forming it.
class MatrixSum::ColumnEntries {
 public:
  ColumnEntries(const Term& term, Index column) {
    const SparseMatrix* nodes = term.nodes();
    if (nodes != nullptr) {
      stride_ = 3;
      offset_ = column % 3;
    }
    at_ = SparseMatrix::InnerIterator(nodes != nullptr ? *nodes : term.whole(), column / stride_);
  }
  explicit operator bool() const { return static_cast<bool>(at_); }
  ColumnEntries& operator++() {
    ++at_;
    return *this;
  }
  Index row() const { return stride_ * at_.row() + offset_; }
  double value() const { return at_.value(); }

 private:
  SparseMatrix::InnerIterator at_;
  Index stride_ = 1, offset_ = 0;
};

template <class Visitor>
void MatrixSum::visit_column(Index column, Index from, Visitor&& visit) const {
  std::vector<ColumnEntries> at;
  at.reserve(terms_.size());
  for (const Term& term : terms_) {
    at.emplace_back(term, column);
    while (at.back() && at.back().row() < from) ++at.back();
  }
  for (;;) {
    constexpr Index kEnd = std::numeric_limits<Index>::max();
    Index row = kEnd;
    for (const auto& it : at) row = it ? std::min(row, it.row()) : row;
    if (row == kEnd) return;
    double value = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (!at[k] || at[k].row() != row) continue;
      value += terms_[k].weight * at[k].value();
      ++at[k];
    }
    visit(row, value);
  }
}

SparseMatrix MatrixSum::columns(Index first, Index count, Triangles which) const {
  const auto first_row = [which](Index column) { return which == Triangles::lower ? column : 0; };
  SparseMatrix out(size(), count);
  int* starts = out.outerIndexPtr();
  starts[0] = 0;
  for (Index k = 0; k < count; ++k) {
    int entries = 0;
    visit_column(first + k, first_row(first + k), [&entries](Index, double) { ++entries; });
    starts[k + 1] = starts[k] + entries;
  }
  out.resizeNonZeros(starts[count]);
  Index place = 0;
  for (Index k = 0; k < count; ++k) {
    visit_column(first + k, first_row(first + k), [&](Index row, double value) {
      out.innerIndexPtr()[place] = static_cast<int>(row);
      out.valuePtr()[place++] = value;
    });
  }
  return out;
}

void MatrixSum::read_column(Index column, std::vector<Entry>& entries) const {
  entries.clear();
  visit_column(column, 0, [&entries](Index row, double value) {
    entries.push_back({static_cast<int>(row), value});
  });
}

void MatrixSum::form_terms() const {
  for (const Term& term : terms_) {
    if (term.nodes() == nullptr) (void)term.whole();
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
