// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/elastic_compliance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::analysis {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Rounding leaves 1e-16 · cond(K_ff), up to 1e-7 for fine meshes; a mechanism leaves about one.
constexpr double kWrongResponse = 1e-3;

[[noreturn]] void refuse(const body::Body& body) {
  throw ModelError(fmt::format(
      "body \"{}\" has no static equilibrium: its mesh can move without strain other than as a "
      "rigid body; brace it, or connect its parts by elements that carry moments",
      body.name));
}

/// Variables whose rows of Φ are independent and large, by QR of Φᵀ with column pivoting. Rotations
/// count with the body's length, so that distant points are preferred to rotations.
std::vector<int> isostatic_variables(const body::Body& body) {
  const body::FlexiblePart& part = *body.flexible;
  Matrix rows = part.sieve.Phi();
  for (const auto& node : part.fe.dofs.node_dofs) {
    for (std::size_t k = 3; k < 6; ++k) {
      if (node[k] >= 0) rows.row(node[k]) *= body.length_scale();
    }
  }
  const Eigen::ColPivHouseholderQR<Matrix> qr(rows.transpose());
  std::vector<int> held(static_cast<std::size_t>(part.sieve.rank()));
  for (std::size_t k = 0; k < held.size(); ++k) {
    held[k] = qr.colsPermutation().indices()[static_cast<Eigen::Index>(k)];
  }
  std::sort(held.begin(), held.end());
  return held;
}

/// K with the rows and columns of the held variables replaced by those of a diagonal matrix.
SparseMatrix grounded(const SparseMatrix& K, const std::vector<int>& held) {
  const auto is_held = [&held](Eigen::Index k) {
    return std::binary_search(held.begin(), held.end(), static_cast<int>(k));
  };
  SparseMatrix out = K;
  out.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return row == column || (!is_held(row) && !is_held(column));
  });
  const double size = K.diagonal().maxCoeff();
  for (const int k : held) out.coeffRef(k, k) = size;
  out.makeCompressed();
  return out;
}

linalg::SparseCholesky factorise(const body::Body& body, const std::vector<int>& held) {
  try {
    return linalg::SparseCholesky(grounded(body.flexible->fe.K, held));
  } catch (const NumericalError&) {
    refuse(body);
  }
}

}  // namespace

ElasticCompliance::ElasticCompliance(const body::Body& body)
    : part_(body.flexible.get()),
      held_(isostatic_variables(body)),
      factor_(factorise(body, held_)) {
  const SparseMatrix N = part_->rows.topRows(part_->num_interface_rows);
  Matrix loads = Matrix(SparseMatrix(N.transpose()));
  columns_.resize(loads.rows(), loads.cols());
  const Vector weight = part_->fe.K.diagonal().unaryExpr(
      [](double stiffness) { return stiffness > 0.0 ? 1.0 / std::sqrt(stiffness) : 0.0; });
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    columns_.col(k) = solve(loads.col(k));
    Vector sieved = loads.col(k);
    part_->sieve.apply_transposed(sieved);
    const Vector wrong = part_->fe.K * columns_.col(k) - sieved;
    const double size = weight.cwiseProduct(loads.col(k)).norm();
    if (!(weight.cwiseProduct(wrong).norm() <= kWrongResponse * size)) refuse(body);
  }
  interface_ = N * columns_;
  interface_ = 0.5 * (interface_ + interface_.transpose().eval());
}

Vector ElasticCompliance::solve(Vector load) const {
  part_->sieve.apply_transposed(load);
  for (const int k : held_) load[k] = 0.0;
  factor_.solve_in_place(load);
  ++solves_;
  part_->sieve.apply(load);
  return load;
}

}  // namespace buckens::analysis
