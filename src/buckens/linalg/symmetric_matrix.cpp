// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/symmetric_matrix.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "buckens/linalg/column_content.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::linalg {

namespace {

/// Of both triangles the lower one counts, as of a divided matrix.
std::array<std::uint64_t, 2> content_of(const SparseMatrix& A) {
  std::array<std::uint64_t, 2> sum{};
  for (int column = 0; column < A.cols(); ++column) {
    const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
    const int* first = std::lower_bound(A.innerIndexPtr() + A.outerIndexPtr()[column], end, column);
    const auto place = static_cast<std::size_t>(first - A.innerIndexPtr());
    const auto count = static_cast<std::size_t>(end - first);
    add_content(column, {first, count}, {A.valuePtr() + place, count}, sum);
  }
  return sum;
}

}  // namespace

SymmetricMatrix::SymmetricMatrix(std::shared_ptr<const DividedMatrix> rows)
    : here_(rows->size(), rows->size()), divided_(std::move(rows)) {}

Eigen::Index SymmetricMatrix::nonZeros() const {
  return divided_ ? divided_->entries() : here_.nonZeros();
}

Vector SymmetricMatrix::diagonal() const {
  return divided_ ? divided_->diagonal() : Vector(here_.diagonal());
}

Vector SymmetricMatrix::near_diagonal(std::span<const int> lengths) const {
  if (divided_) return divided_->near_diagonal(lengths);
  Vector out(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}));
  Eigen::Index next = 0;
  for (Eigen::Index column = 0; column < here_.cols(); ++column) {
    for (int k = 0; k < lengths[static_cast<std::size_t>(column)]; ++k) {
      out[next++] = here_.coeff(column + k, column);
    }
  }
  return out;
}

double SymmetricMatrix::norm() const { return divided_ ? divided_->norm() : here_.norm(); }

const SparseMatrix& SymmetricMatrix::whole() const {
  if (divided_) {
    SparseMatrix A = divided_->gathered();
    here_.swap(A);
    divided_.reset();
  }
  return here_;
}

bool SymmetricMatrix::operator==(const SymmetricMatrix& other) const {
  if (!divided_ && !other.divided_) return have_same_bits(here_, other.here_);
  return rows() == other.rows() && nonZeros() == other.nonZeros() &&
         (divided_ == other.divided_ || content() == other.content());
}

std::array<std::uint64_t, 2> SymmetricMatrix::content() const {
  return divided_ ? divided_->content() : content_of(here_);
}

const DividedMatrix& SymmetricMatrix::divide() const {
  if (!divided_) {
    divided_ = std::make_shared<const DividedMatrix>(here_);
    drop();
  }
  return *divided_;
}

void SymmetricMatrix::share(const SymmetricMatrix& equal) const {
  if (!equal.divided_ || divided_) return;
  divided_ = equal.divided_;
  drop();
}

void SymmetricMatrix::drop() const {
  SparseMatrix nothing(here_.rows(), here_.cols());
  here_.swap(nothing);
}

void SymmetricMatrix::add_product(const Vector& x, Vector& y) const {
  if (divided_) {
    y += *this * x;
  } else {
    y.noalias() += here_ * x;
  }
}

void SymmetricMatrix::multiply(const double* x, double* y) const {
  const DividedMatrix::Product product{divided_.get(), x, y};
  DividedMatrix::multiply({&product, 1});
}

Matrix weighted_product(double weight, const SymmetricMatrix& A, const Matrix& X) {
  if (A.is_divided()) return weight * Matrix(A * X);
  return weight * (A.whole() * X);
}

void multiply(std::initializer_list<MatrixProduct> products) {
  std::vector<DividedMatrix::Product> elsewhere;
  for (const MatrixProduct& product : products) {
    product.y->resize(product.A->rows());
    if (product.A->is_divided()) {
      elsewhere.push_back({&product.A->divide(), product.x->data(), product.y->data()});
    } else {
      product.y->noalias() = product.A->whole() * *product.x;
    }
  }
  DividedMatrix::multiply(elsewhere);
}

}  // namespace buckens::linalg
