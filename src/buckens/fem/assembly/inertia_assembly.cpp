// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/inertia_assembly.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "buckens/fem/assembly/element_pieces.h"
#include "buckens/fem/assembly/entry_sums.h"
#include "buckens/fem/assembly/solid_inertia.h"
#include "buckens/linalg/counted_entries.h"

namespace buckens::fem {

using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

/// Moves what elements have listed behind what others have.
void append(std::vector<Triplet>& listed, std::vector<Triplet>& to) {
  if (to.empty()) {
    to.swap(listed);
  } else {
    to.insert(to.end(), listed.begin(), listed.end());
  }
  listed.clear();
}

/// Adds what elements `begin` to `end` have, except for their scalar mass, and leaves `own` without
/// it.
void add(const ElementBlock& block, int begin, int end, const DofMap& dofs, InertiaSum& own,
         InertiaSum& sum) {
  for (std::size_t k = 0; k < sum.W.size(); ++k) append(own.W[k], sum.W[k]);
  append(own.M_flywheel, sum.M_flywheel);
  sum.C0 += std::exchange(own.C0, Eigen::Matrix3d::Zero());
  sum.J0_flywheel += std::exchange(own.J0_flywheel, Eigen::Matrix3d::Zero());
  for (int e = begin; e < end; ++e) {
    for (const int node : block.nodes(e)) {
      for (const int dof : dofs.node_dofs[static_cast<std::size_t>(node)]) {
        if (dof < 0) continue;
        sum.c.row(dof) += own.c.row(dof);
        own.c.row(dof).setZero();
      }
    }
  }
}

}  // namespace

MassMoment mass_moment(const ElementBlock& block, const MeshView& mesh) {
  const ElementPieces pieces(block, mesh.nodes);
  std::vector<MassMoment> of_pieces(static_cast<std::size_t>(pieces.count()));
  run_tasks(mesh.pool, pieces.count(), [&](int k) {
    pieces.visit(k, [&](const ElementBlock& piece, int) {
      piece.add_mass(mesh.nodes, of_pieces[static_cast<std::size_t>(k)]);
    });
  });
  MassMoment out;
  for (const MassMoment& piece : of_pieces) {
    out.mass += piece.mass;
    out.first += piece.first;
  }
  return out;
}

AssembledInertia assemble_inertia(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                  const MeshView& mesh, const Eigen::Vector3d& com) {
  TaskPool* pool = mesh.pool;
  AssembledInertia out;
  out.sum.c = linalg::Matrix::Zero(mesh.dofs.num_dofs, 9);
  std::optional<EntrySums> Ms;
  std::vector<InertiaSum> sums(pool != nullptr ? static_cast<std::size_t>(pool->threads()) : 1);
  std::vector<std::span<const Triplet>> scalar_masses(sums.size());
  for (const auto& block : blocks) {
    if (block->num_elements() == 0) continue;
    const ElementPieces pieces(*block, mesh.nodes);
    const auto at_once = static_cast<int>(sums.size());
    for (int first = 0; first < pieces.count(); first += at_once) {
      const int count = std::min(at_once, pieces.count() - first);
      run_tasks(pool, count, [&](int k) {
        InertiaSum& own = sums[static_cast<std::size_t>(k)];
        if (own.c.size() == 0) own.c = linalg::Matrix::Zero(mesh.dofs.num_dofs, 9);
        pieces.visit(first + k,
                     [&](const ElementBlock& piece, int) { piece.add_inertia(mesh, com, own); });
      });
      for (int k = 0; k < count; ++k) {
        add(*block, pieces.begin(first + k), pieces.begin(first + k + 1), mesh.dofs,
            sums[static_cast<std::size_t>(k)], out.sum);
      }
      const bool has_scalar_mass = std::any_of(
          sums.begin(), sums.end(), [](const InertiaSum& own) { return !own.nodal.empty(); });
      if (!has_scalar_mass) continue;
      if (!Ms) Ms.emplace(blocks, one_per_node(mesh.nodes.size()), pool);
      for (std::size_t k = 0; k < sums.size(); ++k) scalar_masses[k] = sums[k].nodal;
      Ms->add(scalar_masses, pool);
      for (InertiaSum& own : sums) own.nodal.clear();
    }
  }
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
