// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/made_columns.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "buckens/fem/assembly/inertia_assembly.h"
#include "buckens/fem/assembly/mesh_part.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/fem/assembly/stress_rows.h"
#include "buckens/linalg/counted_entries.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::fem {

using linalg::SparseMatrix;

namespace {

/// Of all variables of a part. Those whose elements are not all here lack something.
SparseMatrix matrix_of(MeshMatrix which, const MeshPart& part) {
  const MeshView mesh{part.nodes, part.dofs};
  if (which == MeshMatrix::mass) {
    AssembledInertia inertia = assemble_inertia(part.blocks, mesh, Eigen::Vector3d::Zero());
    // Only moments depend on the mass centre.
    const int n = part.dofs.num_dofs;
    ShapeIntegrals shape;
    for (std::size_t k = 0; k < 3; ++k) shape.W[k] = taken_matrix(n, inertia.sum.W[k]);
    shape.nodal = {linalg::shared_matrix(std::move(inertia.scalar_mass)), translations(part.dofs)};
    return mass_entries(shape, taken_matrix(n, inertia.sum.M_flywheel), n);
  }
  SparseMatrix out;
  if (which == MeshMatrix::scalar_mass) {
    AssembledInertia inertia = assemble_inertia(part.blocks, mesh, Eigen::Vector3d::Zero());
    out.swap(inertia.scalar_mass);
    return out;
  }
  StiffnessMatrices stiffness = assemble_stiffness(part.blocks, mesh);
  out.swap(which == MeshMatrix::stiffness ? stiffness.K : stiffness.K_damping);
  return out;
}

/// The variables on which columns depend.
std::vector<bool> variables_behind(int num_dofs, int first, int end, const Following* T) {
  std::vector<bool> out(static_cast<std::size_t>(num_dofs), false);
  if (T == nullptr) {
    std::fill(out.begin() + first, out.begin() + end, true);
    return out;
  }
  for (int row = 0; row < num_dofs; ++row) {
    for (Following::InnerIterator it(*T, row); it; ++it) {
      if (it.col() >= first && it.col() < end) out[static_cast<std::size_t>(row)] = true;
    }
  }
  return out;
}

void put_following(const Following& T, const std::vector<int>& variables, base::BytesTo& put) {
  put(static_cast<int>(T.cols()));
  for (const int row : variables) {
    put(T.outerIndexPtr()[row + 1] - T.outerIndexPtr()[row]);
    for (Following::InnerIterator it(T, row); it; ++it) {
      put(static_cast<int>(it.col()));
      put(it.value());
    }
  }
}

/// Rows of T, its columns numbered among those that have entries here.
struct PartFollowing {
  int size = 0;              ///< columns of all of T
  std::vector<int> columns;  ///< of T, ascending, for each of those here
  SparseMatrix T;
};

PartFollowing taken_following(std::size_t rows, base::BytesFrom& take) {
  PartFollowing out;
  take(out.size);
  std::vector<linalg::Triplet> entries;
  for (std::size_t row = 0; row < rows; ++row) {
    for (int left = take.next<int>(); left > 0; --left) {
      const int column = take.next<int>();
      entries.emplace_back(static_cast<int>(row), column, take.next<double>());
      out.columns.push_back(column);
    }
  }
  std::sort(out.columns.begin(), out.columns.end());
  out.columns.erase(std::unique(out.columns.begin(), out.columns.end()), out.columns.end());
  const auto place = [&out](int column) {
    return std::lower_bound(out.columns.begin(), out.columns.end(), column) - out.columns.begin();
  };
  for (linalg::Triplet& entry : entries) {
    entry = {entry.row(), static_cast<int>(place(entry.col())), entry.value()};
  }
  out.T.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(out.columns.size()));
  out.T.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

std::vector<std::byte> description_of_columns(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, int first, int end, const Following* T) {
  base::BytesTo put;
  put(which);
  const std::vector<int> variables =
      put_part(blocks, mesh, variables_behind(mesh.dofs.num_dofs, first, end, T), put);
  put(T != nullptr);
  if (T != nullptr) put_following(*T, variables, put);
  return put.take();
}

linalg::SymmetricMatrix matrix_made_elsewhere(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, const Following* T) {
  const auto describe = [&](int first, int end) {
    return description_of_columns(which, blocks, mesh, first, end, T);
  };
  return linalg::SymmetricMatrix(std::make_shared<const linalg::DividedMatrix>(
      T != nullptr ? T->cols() : mesh.dofs.num_dofs, describe));
}

SparseMatrix made_columns(std::span<const std::byte> description, int first, int end) {
  base::BytesFrom take(description);
  const auto which = take.next<MeshMatrix>();
  if (which == MeshMatrix::stress) return made_stress_rows(take, first, end);
  const MeshPart part = taken_part(take);
  SparseMatrix A = matrix_of(which, part);
  const bool follows = take.next<bool>();
  PartFollowing following;
  if (follows) {
    following = taken_following(part.variables.size(), take);
    A = condensed(A, following.T);
  }
  const std::vector<int>& variables = follows ? following.columns : part.variables;
  const auto visit = [&](auto&& entry) {
    for (int k = 0; k < A.outerSize(); ++k) {
      const int column = variables[static_cast<std::size_t>(k)];
      if (column < first || column >= end) continue;
      for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
        if (it.row() < k) continue;
        entry(variables[static_cast<std::size_t>(it.row())], column - first, it.value());
      }
    }
  };
  return linalg::from_counted_entries(follows ? following.size : part.size, end - first, visit);
}

SparseMatrix condensed(const SparseMatrix& A, const SparseMatrix& T) {
  if (A.nonZeros() == 0) return {T.cols(), T.cols()};
  const SparseMatrix AT = A * T;
  return T.transpose() * AT;
}

}  // namespace buckens::fem
