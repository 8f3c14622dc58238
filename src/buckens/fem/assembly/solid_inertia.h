// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/element/node_parts.h"
#include "buckens/fem/element/shape_integrals.h"
#include "buckens/linalg/shared_matrix.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::fem {

/// Inertia integrals over the solids of a mesh, as products with their scalar mass matrix Ms.
///
/// Shape functions reproduce the position, so that c and C0 are sums of x and Ms: no element is
/// integrated again. Where several processes share the work, each of the others makes the columns
/// of Ms of its nodes, from the elements around them, and adds its share to the products. Shares
/// are added in the order of the processes. Mass and mass centre are integrated by the first one
/// alone.
class SolidInertia {
 public:
  /// @param Ms N×N, divided or not
  /// @param nodes outlive this object
  SolidInertia(linalg::SymmetricMatrix Ms, const std::vector<Node>& nodes);

  /// Adds to c and C0. @param com mass centre of the whole body in model axes [m]
  void add_moments(const DofMap& dofs, const Eigen::Vector3d& com, InertiaSum& sum) const;
  /// In this process, with the bits of an assembly there.
  const linalg::SparseMatrix& scalar_mass() const { return Ms_.whole(); }

 private:
  linalg::SymmetricMatrix Ms_;
  const std::vector<Node>* nodes_;
};

/// Ms of the solids of a mesh, columns of which the other processes make.
/// @pre linalg::is_shared_work() of its variables
/// @throws NumericalError if a process cannot, with its reason
linalg::SymmetricMatrix solid_mass_made_elsewhere(const std::shared_ptr<const ElementBlock>& solids,
                                                  const std::vector<Node>& nodes,
                                                  const NodeParts& parts);

/// Makes Ms of the solids again, in this process. Holds the positions of the nodes.
linalg::SharedMatrix::Make solid_mass_again(std::shared_ptr<const ElementBlock> solids,
                                            const std::vector<Node>& nodes, NodeParts parts);

/// One variable per node, of the number of the node.
DofMap one_per_node(std::size_t num_nodes);

}  // namespace buckens::fem
