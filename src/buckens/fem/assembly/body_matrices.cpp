// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/body_matrices.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/sparse_ldlt.h"

namespace buckens::fem {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::SparseMatrix;

namespace {

// Share of the norm of K up to which a rigid motion counts as free: far above the rounding of
// matrices written with twelve digits, far below any spring to ground.
constexpr double kStrainTolerance = 1e-9;
// Larger matrices are only judged by their 2×2 minors: a factorisation here would take as long as
// that of the simulation.
constexpr int kMostFactored = 6000;
// Shift that lets massless variables pass.
constexpr double kMassless = 1e-12;

/// "displacement x of node n12"
std::string row_name(const BodyMatrices& body, Eigen::Index row) {
  constexpr const char* kinds[] = {"displacement x", "displacement y", "displacement z",
                                   "rotation x",     "rotation y",     "rotation z"};
  for (std::size_t node = 0; node < body.dofs.node_dofs.size(); ++node) {
    for (std::size_t k = 0; k < 6; ++k) {
      if (body.dofs.node_dofs[node][k] != row) continue;
      return fmt::format("{} of {}", kinds[k], node_label(body.nodes, static_cast<int>(node)));
    }
  }
  return fmt::format("row {}", row + 1);
}

void check_minors(const BodyMatrices& body, const SparseMatrix& A, const char* name) {
  const linalg::Vector diagonal = A.diagonal();
  const double largest = diagonal.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] >= -1e-12 * largest) continue;
    throw ModelError(
        fmt::format("the {} matrix has {:g} on its diagonal for the {}; such a body "
                    "would gain energy by moving. Are mass and stiffness swapped?",
                    name, diagonal[i], row_name(body, i)));
  }
  for (int column = 0; column < A.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
      const double bound = std::sqrt(std::abs(diagonal[it.row()] * diagonal[column]));
      if (std::abs(it.value()) <= (1.0 + 1e-9) * bound + 1e-12 * largest) continue;
      throw ModelError(
          fmt::format("the {} matrix is not positive: {:g} between the {} and the {} "
                      "exceeds the root of their diagonal entries, {:g}",
                      name, it.value(), row_name(body, it.row()), row_name(body, column), bound));
    }
  }
}

void check_mass(const BodyMatrices& body) {
  check_minors(body, body.M, "mass");
  if (body.dofs.num_dofs > kMostFactored) return;
  SparseMatrix shifted = body.M;
  const double largest = body.M.diagonal().maxCoeff();
  for (int i = 0; i < body.dofs.num_dofs; ++i) shifted.coeffRef(i, i) += kMassless * largest;
  linalg::SparseLdlt factor;
  factor.analyse(shifted);
  if (factor.factorise(shifted) && factor.diagonal().minCoeff() > 0.0) return;
  throw ModelError(
      "the mass matrix is not positive: some motion of the nodes would have negative kinetic "
      "energy");
}

Matrix rigid_motions(const BodyMatrices& body, const Vector3d& com) {
  Matrix out = Matrix::Zero(body.dofs.num_dofs, 6);
  for (std::size_t node = 0; node < body.nodes.size(); ++node) {
    const Vector3d x = body.nodes[node].position - com;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& dofs = body.dofs.node_dofs[node];
      out(dofs[static_cast<std::size_t>(axis)], axis) = 1.0;
      const Vector3d turned = Vector3d::Unit(axis).cross(x);
      for (int k = 0; k < 3; ++k) out(dofs[static_cast<std::size_t>(k)], 3 + axis) = turned[k];
      const int rotation = dofs[static_cast<std::size_t>(3 + axis)];
      if (rotation >= 0) out(rotation, 3 + axis) = 1.0;
    }
  }
  return out;
}

/// Refuses matrices that resist a rigid motion.
/// @param size norm of the matrix from which A was made, that of A where it is as written
void check_free(const BodyMatrices& body, const SparseMatrix& A, double size, const Matrix& Phi,
                const char* name) {
  constexpr const char* motions[] = {"displacement along x", "displacement along y",
                                     "displacement along z", "rotation about x",
                                     "rotation about y",     "rotation about z"};
  const Matrix forces = A * Phi;
  int worst = 0;
  double largest = 0.0;
  for (int k = 0; k < 6; ++k) {
    const double share = forces.col(k).norm() / (size * Phi.col(k).norm());
    if (share > largest) worst = k;
    largest = std::max(largest, share);
  }
  if (largest <= kStrainTolerance) return;
  Eigen::Index row = 0;
  forces.col(worst).cwiseAbs().maxCoeff(&row);
  throw ModelError(fmt::format(
      "the {} matrix resists the rigid {} (by {:.2g} of its norm, most at the {}). Write the "
      "matrices of the free body, without supports and constraints, with at least 12 digits, and "
      "see that the table of nodes has the right places, order of rows and units",
      name, motions[worst], largest, row_name(body, row)));
}

}  // namespace

FeModel assemble(const BodyMatrices& body, const RayleighFactors& damping) {
  check_mass(body);
  check_minors(body, body.K, "stiffness");
  FeModel fe;
  fe.nodes = body.nodes;
  fe.dofs = body.dofs;
  fe.M = body.M;
  fe.K = body.K;
  fe.shape = matrix_integrals(body);
  const Matrix Phi = rigid_motions(body, fe.shape.com);
  if (!(body.K.norm() > 0.0)) {
    throw ModelError("the stiffness matrix is zero; is it the right file?");
  }
  check_free(body, body.K, body.K.norm(), Phi, "stiffness");
  fe.mass_damping = damping.mass;
  fe.damps_held_motion = damping.damps_held_motion;
  fe.K_damping = SparseMatrix(body.dofs.num_dofs, body.dofs.num_dofs);
  if (body.C.nonZeros() > 0 && body.C.norm() > 0.0) {
    check_minors(body, body.C, "damping");
    // What resists translation must be α M.
    const double drag = Phi.col(0).dot(body.C * Phi.col(0));
    const bool is_free = drag <= kStrainTolerance * body.C.norm() * Phi.col(0).squaredNorm();
    fe.mass_damping = is_free ? 0.0 : drag / fe.shape.mass;
    fe.K_damping = SparseMatrix(body.C - fe.mass_damping * body.M);
    // Of C = α M only rounding is left.
    check_free(body, fe.K_damping, body.C.norm(), Phi, "damping");
  } else if (damping.stiffness > 0.0) {
    fe.K_damping = SparseMatrix(damping.stiffness * body.K);
  }
  return fe;
}

}  // namespace buckens::fem
