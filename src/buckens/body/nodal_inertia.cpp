// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_inertia.h"

#include <array>

#include "buckens/linalg/row_parts.h"

namespace buckens::body {

using Eigen::Matrix3Xd;
using linalg::Vector;

NodalInertia::NodalInertia(const fem::NodalMass& mass)
    : mass_(&mass), is_regular_(mass.is_numbered_by_node()), read_(mass.Ms) {}

Matrix3Xd NodalInertia::by_node(const Vector& x) const {
  Matrix3Xd X(3, static_cast<Eigen::Index>(mass_->dofs.size()));
  for (std::size_t node = 0; node < mass_->dofs.size(); ++node) {
    for (std::size_t a = 0; a < 3; ++a) {
      const int dof = mass_->dofs[node][a];
      X(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(node)) = dof >= 0 ? x[dof] : 0.0;
    }
  }
  return X;
}

Matrix3Xd NodalInertia::times_mass(const Vector& x) const { return by_node(x) * *mass_->Ms; }

void NodalInertia::multiply(const Vector& x, Vector& y, TaskPool* pool) const {
  if (is_regular_ && y.size() == 3 * read_.rows()) {
    const linalg::NodeKernels& kernels = linalg::node_kernels();
    const linalg::NodeMatrix Ms = matrix();
    const linalg::RowParts nodes(Ms.nodes);
    nodes.for_pieces(pool, [&](int /*part*/, Eigen::Index first, Eigen::Index count) {
      kernels.multiply(Ms, static_cast<int>(first), static_cast<int>(count), x.data(), y.data());
    });
    return;
  }
  const linalg::SparseMatrix& Ms = *mass_->Ms;
  y.setZero();
  for (int node = 0; node < Ms.outerSize(); ++node) {
    const auto& to = mass_->dofs[static_cast<std::size_t>(node)];
    std::array<double, 3> sum{};
    for (linalg::SparseMatrix::InnerIterator it(Ms, node); it; ++it) {
      const auto& from = mass_->dofs[static_cast<std::size_t>(it.row())];
      for (std::size_t a = 0; a < 3; ++a) {
        if (from[a] >= 0) sum[a] += it.value() * x[from[a]];
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      if (to[a] >= 0) y[to[a]] = sum[a];
    }
  }
}

void NodalInertia::add(const Matrix3Xd& by_node, Vector& y) const {
  for (std::size_t node = 0; node < mass_->dofs.size(); ++node) {
    for (std::size_t a = 0; a < 3; ++a) {
      const int dof = mass_->dofs[node][a];
      if (dof >= 0)
        y[dof] += by_node(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(node));
    }
  }
}

}  // namespace buckens::body
