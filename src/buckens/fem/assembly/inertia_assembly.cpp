// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/inertia_assembly.h"

#include <optional>

#include "buckens/fem/assembly/element_pieces.h"
#include "buckens/fem/assembly/solid_inertia.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/linalg/counted_entries.h"

namespace buckens::fem {

using linalg::SparseMatrix;
using linalg::Triplet;

AssembledInertia assemble_inertia(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                  const MeshView& mesh, const Eigen::Vector3d& com) {
  AssembledInertia out;
  out.sum.c = linalg::Matrix::Zero(mesh.dofs.num_dofs, 9);
  std::optional<EntrySums> Ms;
  for (const auto& block : blocks) {
    visit_pieces(*block, mesh.nodes, [&](const ElementBlock& piece, int) {
      piece.add_inertia(mesh, com, out.sum);
      if (out.sum.nodal.empty()) return;
      if (!Ms) Ms.emplace(blocks, one_per_node(mesh.nodes.size()));
      Ms->add(out.sum.nodal);
      out.sum.nodal.clear();
    });
  }
  std::vector<Triplet>().swap(out.sum.nodal);
  if (Ms) Ms->take().swap(out.scalar_mass);
  return out;
}

std::vector<std::array<int, 3>> translations(const DofMap& dofs) {
  std::vector<std::array<int, 3>> out;
  for (const auto& node : dofs.node_dofs) out.push_back({node[0], node[1], node[2]});
  return out;
}

SparseMatrix taken_matrix(int n, std::vector<Triplet>& listed) {
  SparseMatrix A(n, n);
  A.setFromTriplets(listed.begin(), listed.end());
  std::vector<Triplet>().swap(listed);
  return A;
}

namespace {

bool is_scalar(const ShapeIntegrals& shape, const SparseMatrix& flywheel) {
  return flywheel.nonZeros() == 0 && shape.W[0].nonZeros() == 0 && shape.W[1].nonZeros() == 0 &&
         shape.W[2].nonZeros() == 0 && !shape.nodal.empty();
}

}  // namespace

linalg::SymmetricMatrix mass_matrix(const ShapeIntegrals& shape, const SparseMatrix& flywheel,
                                    int n) {
  const NodalMass& nodal = shape.nodal;
  if (is_scalar(shape, flywheel) && nodal.is_numbered_by_node() && n == 3 * nodal.Ms.rows()) {
    return linalg::SymmetricMatrix::by_node(nodal.Ms.pointer());
  }
  return mass_entries(shape, flywheel, n);
}

SparseMatrix mass_entries(const ShapeIntegrals& shape, const SparseMatrix& flywheel, int n) {
  if (is_scalar(shape, flywheel)) return mass_of_nodes(shape.nodal, n);
  SparseMatrix M(n, n);
  if (shape.W[0].rows() == n) {
    M = shape.W[0] + shape.W[1];
    M += shape.W[2];
  }
  M += flywheel;
  if (!shape.nodal.empty()) M += mass_of_nodes(shape.nodal, n);
  M.makeCompressed();
  return M;
}

SparseMatrix mass_of_nodes(const NodalMass& nodal, int n) {
  const auto visit = [&nodal](auto&& entry) {
    for (int to = 0; to < nodal.Ms->outerSize(); ++to) {
      for (std::size_t a = 0; a < 3; ++a) {
        const int column = nodal.dofs[static_cast<std::size_t>(to)][a];
        if (column < 0) continue;
        for (SparseMatrix::InnerIterator it(*nodal.Ms, to); it; ++it) {
          const int row = nodal.dofs[static_cast<std::size_t>(it.row())][a];
          if (row >= 0) entry(row, column, it.value());
        }
      }
    }
  };
  // Variables ascend with nodes, and so do columns and rows here.
  return linalg::from_counted_entries(n, n, visit);
}

}  // namespace buckens::fem
