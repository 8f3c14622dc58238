// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduction.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "buckens/body/second_moments.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

SparseMatrix diagonal(const Vector& entries) {
  SparseMatrix out(entries.size(), entries.size());
  for (Eigen::Index k = 0; k < entries.size(); ++k) out.insert(k, k) = entries[k];
  out.makeCompressed();
  return out;
}

/// ZᵀAZ; what is diagonal but for rounding becomes diagonal.
SparseMatrix projected(const linalg::SymmetricMatrix& A, const Matrix& Z) {
  const Matrix full = Z.transpose() * (A * Z);
  const Vector size = full.diagonal().cwiseAbs().cwiseSqrt();
  std::vector<linalg::Triplet> entries;
  for (Eigen::Index j = 0; j < full.cols(); ++j) {
    for (Eigen::Index i = 0; i < full.rows(); ++i) {
      if (i != j && std::abs(full(i, j)) <= 1e-12 * size[i] * size[j]) continue;
      if (full(i, j) != 0.0) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), full(i, j));
      }
    }
  }
  SparseMatrix out(full.rows(), full.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

fem::ShapeIntegrals projected(const FlexiblePart& part, const Matrix& Z) {
  const fem::ShapeIntegrals& full = part.fe.shape;
  fem::ShapeIntegrals out;
  out.mass = full.mass;
  out.com = full.com;
  out.C0 = full.C0;
  out.J0 = full.J0;
  out.c = Z.transpose() * part.invariants.first_moments();
  for (std::size_t k = 0; k < out.W.size(); ++k) {
    Eigen::Matrix3d pair = Eigen::Matrix3d::Zero();
    pair(kPairs[k][0], kPairs[k][1]) = 1.0;
    Matrix WZ = Matrix::Zero(Z.rows(), Z.cols());
    for (Eigen::Index j = 0; j < Z.cols(); ++j) {
      Vector column = Vector::Zero(Z.rows());
      part.invariants.add_weighted(pair, Z.col(j), column);
      WZ.col(j) = column;
    }
    out.W[k] = Matrix(Z.transpose() * WZ).sparseView();
  }
  return out;
}

/// Takes all inertia of its own from a deformation.
void drop_rates(fem::FeModel& fe) {
  fe.M = SparseMatrix(fe.M.rows(), fe.M.cols());
  fe.K_damping = SparseMatrix(fe.M.rows(), fe.M.cols());
  fe.mass_damping = 0;
}

}  // namespace

std::unique_ptr<FlexiblePart> reduce(const std::string& body, const FlexiblePart& part,
                                     const ReducedBasis& basis) {
  const Matrix& Z = basis.Z;
  fem::FeModel fe;
  fe.nodes = part.mesh().nodes;
  fe.dofs.num_dofs = static_cast<int>(Z.cols());
  std::array<int, 6> none{};
  none.fill(-1);
  fe.dofs.node_dofs.assign(fe.nodes.size(), none);  // no coordinate belongs to a node
  fe.M = diagonal(Vector::Ones(Z.cols()));
  fe.K = diagonal(basis.omega.cwiseAbs2());
  fe.K_damping = projected(part.fe.K_damping, Z);
  fe.mass_damping = part.fe.mass_damping;
  fe.damps_held_motion = part.fe.damps_held_motion;
  fe.shape = projected(part, Z);
  if (part.is_quasi_static) drop_rates(fe);
  auto out = std::make_unique<FlexiblePart>(body, std::move(fe), part.coupling);
  out->is_quasi_static = part.is_quasi_static;
  out->full_mesh = part.full_mesh ? part.full_mesh : std::make_shared<const fem::FeModel>(part.fe);
  out->recovery = part.recovery.of(Z);
  out->rows = Matrix(part.rows * Z).sparseView();
  out->num_interface_rows = part.num_interface_rows;
  out->num_pattern_rows = part.num_pattern_rows;
  out->reduction.modes = basis.num_modes;
  out->reduction.static_shapes = basis.num_residuals;
  out->reduction.full_dofs = static_cast<int>(Z.rows());
  out->reduction.highest_mode = basis.highest_mode;
  out->reduction.static_share = basis.static_share;
  return out;
}

}  // namespace buckens::body
