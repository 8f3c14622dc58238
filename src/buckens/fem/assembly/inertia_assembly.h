// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/element/shape_integrals.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::fem {

struct AssembledInertia {
  InertiaSum sum;                    ///< without `nodal`
  linalg::SparseMatrix scalar_mass;  ///< of what elements have added to `nodal`, or empty
};

/// Of all elements of a block.
MassMoment mass_moment(const ElementBlock& block, const MeshView& mesh);

/// Sums the inertia of all elements, a hundred or so per thread at a time.
/// @param com mass centre of the whole body in model axes [m]
AssembledInertia assemble_inertia(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                  const MeshView& mesh, const Eigen::Vector3d& com);

/// Of each node, as NodalMass::dofs.
std::vector<std::array<int, 3>> translations(const DofMap& dofs);

/// The n×n sum of what elements have listed, in its order. Empties the list.
linalg::SparseMatrix taken_matrix(int n, std::vector<linalg::Triplet>& listed);

/// M, n×n: W_11 + W_22 + W_33 with the scalar mass matrix, and what is not in them. Of solids alone
/// it reads the scalar mass matrix, where variables are numbered by node.
linalg::SymmetricMatrix mass_matrix(const ShapeIntegrals& shape,
                                    const linalg::SparseMatrix& flywheel, int n);
/// The same with all entries.
linalg::SparseMatrix mass_entries(const ShapeIntegrals& shape, const linalg::SparseMatrix& flywheel,
                                  int n);

/// Ms ⊗ 1 over the variables, n×n.
linalg::SparseMatrix mass_of_nodes(const NodalMass& nodal, int n);

}  // namespace buckens::fem
