// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/elastic_inverse.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/of_body.h"
#include "buckens/linalg/pivoted_qr.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

// Rounding leaves 1e-16 · cond(K_g), up to 1e-7 for fine meshes; a mechanism leaves about one.
constexpr double kWrongResponse = 1e-3;

[[noreturn]] void refuse(const std::string& body) {
  throw ModelError(fmt::format(
      "body \"{}\" has no static equilibrium: its mesh can move without strain other than as a "
      "rigid body; brace it, or connect its parts by elements that carry moments",
      body));
}

/// Variables whose rows of Φ are independent and large, by QR of Φᵀ with column pivoting. Rotations
/// count with the body's length, so that distant points are preferred to rotations.
std::vector<int> isostatic_variables(const fem::FeModel& fe, const Sieve& sieve, double length) {
  if (sieve.rank() == 0) return {};
  Matrix rows = sieve.Phi();
  for (const auto& node : fe.dofs.node_dofs) {
    for (std::size_t k = 3; k < 6; ++k) {
      if (node[k] >= 0) rows.row(node[k]) *= length;
    }
  }
  std::vector<int> held = linalg::PivotedQr(rows.transpose()).order();
  held.resize(static_cast<std::size_t>(sieve.rank()));
  std::sort(held.begin(), held.end());
  return held;
}

/// K_g of a K that is in this process.
SparseMatrix grounded(const SymmetricMatrix& K, const std::vector<int>& held) {
  const auto is_held = [&held](Eigen::Index k) {
    return std::binary_search(held.begin(), held.end(), static_cast<int>(k));
  };
  SparseMatrix out = K.copied();
  out.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return row == column || (!is_held(row) && !is_held(column));
  });
  const double size = K.diagonal().maxCoeff();
  for (const int k : held) out.coeffRef(k, k) = size;
  out.makeCompressed();
  return out;
}

std::shared_ptr<const linalg::Factor> make_grounded(const SymmetricMatrix& K,
                                                    const std::vector<int>& held,
                                                    const linalg::MakeFactor& make) {
  if (!K.is_divided()) return make(grounded(K, held));
  const SymmetricMatrix difference = grounding(K, held);
  linalg::MatrixSum sum;
  sum.add(1.0, K);
  sum.add(1.0, difference);
  return make(sum);
}

std::shared_ptr<const linalg::Factor> factorise(const std::string& body, const SymmetricMatrix& K,
                                                const std::vector<int>& held,
                                                const linalg::MakeFactor& make) {
  return of_body(body, [&] {
    try {
      return make_grounded(K, held, make);
    } catch (const linalg::IndefiniteMatrix&) {
      refuse(body);
    }
  });
}

}  // namespace

SparseMatrix grounding(const SymmetricMatrix& K, const std::vector<int>& held) {
  const Vector diagonal = K.diagonal();
  const double size = diagonal.maxCoeff();
  std::vector<linalg::Triplet> entries;
  for (const int k : held) {
    // Each entry times one, plus zeros: the entries of K themselves.
    const Vector column = K * Vector::Unit(K.rows(), k);
    for (int i = 0; i < static_cast<int>(column.size()); ++i) {
      if (column[i] == 0.0 || i == k) continue;
      entries.emplace_back(i, k, -column[i]);
      // The column of another held variable has the entry across the diagonal.
      if (!std::binary_search(held.begin(), held.end(), i)) entries.emplace_back(k, i, -column[i]);
    }
    entries.emplace_back(k, k, size - diagonal[k]);
  }
  SparseMatrix out(K.rows(), K.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

ElasticInverse::ElasticInverse(const std::string& body, const fem::FeModel& fe, const Sieve& sieve,
                               double length, const linalg::MakeFactor& make)
    : body_(body),
      fe_(&fe),
      sieve_(&sieve),
      held_(isostatic_variables(fe, sieve, length)),
      factor_(factorise(body, fe.K, held_, make)) {}

Vector ElasticInverse::solve(Vector load) const {
  sieve_->apply_transposed(load);
  for (const int k : held_) load[k] = 0.0;
  factor_->solve_in_place(load);
  ++solves_;
  sieve_->apply(load);
  return load;
}

Matrix ElasticInverse::solve_checked(const Matrix& loads) const {
  Matrix columns(loads.rows(), loads.cols());
  const Vector weight = fe_->K.diagonal().unaryExpr(
      [](double stiffness) { return stiffness > 0.0 ? 1.0 / std::sqrt(stiffness) : 0.0; });
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    columns.col(k) = solve(loads.col(k));
    Vector sieved = loads.col(k);
    sieve_->apply_transposed(sieved);
    const Vector wrong = fe_->K * columns.col(k) - sieved;
    const double size = weight.cwiseProduct(loads.col(k)).norm();
    if (!(weight.cwiseProduct(wrong).norm() <= kWrongResponse * size)) refuse(body_);
  }
  return columns;
}

}  // namespace buckens::body
