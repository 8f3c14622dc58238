// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/small_body_answers.h"

#include <utility>

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

/// out += factor M x with a size known to the compiler.
template <int N>
inline void add_sized(const Matrix& M, double factor, const double* x, double* out) {
  Eigen::Map<Eigen::Matrix<double, N, 1>> y(out);
  const Eigen::Map<const Eigen::Matrix<double, N, 1>> v(x);
  y.noalias() += Eigen::Map<const Eigen::Matrix<double, N, N>>(M.data()) * (factor * v);
}

}  // namespace

SmallBodyAnswers::SmallBodyAnswers(const RowMatrix& N, Matrix A, Matrix B)
    : n_(static_cast<int>(N.cols())), num_rows_(N.rows()), A_(std::move(A)), B_(std::move(B)) {
  for (int row = 0; row < N.outerSize(); ++row) {
    for (RowMatrix::InnerIterator it(N, row); it; ++it) {
      if (it.value() != 0.0) N_.push_back({row, static_cast<int>(it.col()), it.value()});
    }
  }
}

SmallBodyAnswers::Variables SmallBodyAnswers::gather(const Vector& f) const {
  Variables x{};
  for (const Entry& entry : N_) {
    x[static_cast<std::size_t>(entry.column)] += entry.value * f[entry.row];
  }
  return x;
}

void SmallBodyAnswers::spread(const double* x, Vector& y) const {
  for (const Entry& entry : N_) y[entry.row] += entry.value * x[entry.column];
}

void SmallBodyAnswers::add_product(const Matrix& M, double factor, const Variables& x,
                                   Variables& out) const {
  switch (n_) {
    case 6:
      return add_sized<6>(M, factor, x.data(), out.data());
    case 12:
      return add_sized<12>(M, factor, x.data(), out.data());
    default:
      for (int j = 0; j < n_; ++j) {
        const double value = factor * x[static_cast<std::size_t>(j)];
        for (int i = 0; i < n_; ++i) out[static_cast<std::size_t>(i)] += M(i, j) * value;
      }
  }
}

void SmallBodyAnswers::add(double c, const Vector& f, Vector& y) const {
  Variables moved{};
  add_product(A_, c, gather(f), moved);
  spread(moved.data(), y);
}

void SmallBodyAnswers::add(double c, const Vector& f, const Vector& e, Vector& y) const {
  Variables moved{};
  add_product(A_, c, gather(f), moved);
  add_product(B_, 1.0, gather(e), moved);
  spread(moved.data(), y);
}

void SmallBodyAnswers::correct(const Vector& e, Vector& y, Vector& z) const {
  const Variables load = gather(e);
  Variables moved{};
  add_product(A_, 1.0, load, moved);
  y.setZero(num_rows_);
  spread(moved.data(), y);
  moved = {};
  add_product(B_, 1.0, load, moved);
  spread(moved.data(), z);
}

void SmallBodyAnswers::row_values(const Vector& d, Vector& y) const {
  y.setZero(num_rows_);
  spread(d.data(), y);
}

}  // namespace buckens::stepping
