// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/constraint/node_links.h"
#include "buckens/fem/fe_model.h"

namespace buckens::fem {

/// A mesh whose links are solved for their dependent variables: d = T x.
struct Elimination {
  linalg::SparseMatrix T;  ///< all variables in terms of the independent ones
  DofMap dofs;             ///< indices of the independent variables; −1 for dependent ones
  /// Per node whether T only renumbers its variables.
  std::vector<bool> is_free;
};

/// Solves the links of a mesh by elimination with pivoting.
///
/// Every link is a row Σ c_j d_j = 0. Rows are processed in turn: variables already dependent are
/// substituted, then the requested variable, or if it is no longer there the one with the largest
/// coefficient, is made to depend on the others. Chains and loops of links are solved exactly; a
/// row that adds nothing new is left out. Rotations count as displacements at the mean distance of
/// the nodes.
/// @param positions as many as nodes in `dofs`, model axes [m]
/// @throws ModelError naming an equation that would prevent a rigid motion of the body, an average
/// whose nodes do not determine a rotation that its reference needs, or a variable that does not
/// exist
Elimination eliminate(const std::vector<Node>& nodes, const DofMap& dofs, const NodeLinks& links);

}  // namespace buckens::fem
