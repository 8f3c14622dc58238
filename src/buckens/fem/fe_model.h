// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/element/dof_map.h"
#include "buckens/fem/element/node_parts.h"
#include "buckens/fem/element/shape_integrals.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::fem {

class ElementBlock;

/// The constant matrices of one finite-element body: M d̈ + C ḋ + K d = f in the body frame, with
/// C = α M + K_damping, and the inertia integrals that couple d to the frame's motion.
///
/// Made by assemble(); see structure.h for its input and recovery.h for stresses and section
/// forces.
struct FeModel {
  std::vector<Node> nodes;
  DofMap dofs;
  NodeParts parts;
  linalg::SymmetricMatrix M;          ///< consistent mass, n×n [kg, kg m, kg m²]
  linalg::SymmetricMatrix K;          ///< stiffness, n×n [N/m, N, N m]
  linalg::SymmetricMatrix K_damping;  ///< Σ β K over materials, n×n; no entries where undamped
  double mass_damping = 0;            ///< α [1/s], one value per body
  /// α acts on the motion of the body as held by its joints, not on that relative to its frame.
  bool damps_held_motion = false;
  ShapeIntegrals shape;
  /// The elements, by kind. Elements are numbered through all blocks in this order.
  std::vector<std::shared_ptr<const ElementBlock>> blocks;
};

}  // namespace buckens::fem
