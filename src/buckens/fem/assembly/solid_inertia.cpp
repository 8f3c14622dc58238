// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/solid_inertia.h"

#include <array>
#include <utility>

#include "buckens/fem/assembly/made_columns.h"
#include "buckens/fem/assembly/mesh_division.h"

namespace buckens::fem {

using linalg::Vector;

SolidInertia::SolidInertia(linalg::SymmetricMatrix Ms, const std::vector<Node>& nodes)
    : Ms_(std::move(Ms)), nodes_(&nodes) {}

void SolidInertia::add_moments(const DofMap& dofs, const Eigen::Vector3d& com,
                               InertiaSum& sum) const {
  std::array<Vector, 3> x0, moment;  // of the nodes; Σ_J Ms_IJ x0_J
  for (std::size_t a = 0; a < 3; ++a) {
    x0[a].resize(Ms_.rows());
    moment[a].resize(Ms_.rows());
    for (std::size_t node = 0; node < nodes_->size(); ++node) {
      const auto axis = static_cast<Eigen::Index>(a);
      x0[a][static_cast<Eigen::Index>(node)] = (*nodes_)[node].position[axis] - com[axis];
    }
  }
  linalg::multiply(
      {{&Ms_, &x0[0], &moment[0]}, {&Ms_, &x0[1], &moment[1]}, {&Ms_, &x0[2], &moment[2]}});
  Eigen::Matrix3d second;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      second(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = moment[a].dot(x0[b]);
    }
    for (std::size_t node = 0; node < nodes_->size(); ++node) {
      for (std::size_t b = 0; b < 3; ++b) {
        const int dof = dofs.node_dofs[node][b];
        if (dof < 0) continue;
        sum.c(dof, static_cast<Eigen::Index>(3 * a + b)) +=
            moment[a][static_cast<Eigen::Index>(node)];
      }
    }
  }
  sum.C0 += 0.5 * (second + second.transpose());
}

linalg::SymmetricMatrix solid_mass_made_elsewhere(const std::shared_ptr<const ElementBlock>& solids,
                                                  const std::vector<Node>& nodes,
                                                  const NodeParts& parts) {
  const DofMap numbers = one_per_node(nodes.size());
  return matrix_made_elsewhere(MeshMatrix::scalar_mass, {solids}, {nodes, numbers},
                               row_order(numbers, parts));
}

linalg::SharedMatrix::Make solid_mass_again(std::shared_ptr<const ElementBlock> solids,
                                            const std::vector<Node>& nodes, NodeParts parts) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    positions.col(static_cast<Eigen::Index>(node)) = nodes[node].position;
  }
  return [solids = std::move(solids), positions = std::move(positions), parts = std::move(parts)] {
    std::vector<Node> places(static_cast<std::size_t>(positions.cols()));
    for (std::size_t node = 0; node < places.size(); ++node) {
      places[node].position = positions.col(static_cast<Eigen::Index>(node));
    }
    return solid_mass_made_elsewhere(solids, places, parts).copied();
  };
}

DofMap one_per_node(std::size_t num_nodes) {
  DofMap out;
  for (std::size_t node = 0; node < num_nodes; ++node) {
    out.node_dofs.push_back({out.num_dofs++, -1, -1, -1, -1, -1});
  }
  return out;
}

}  // namespace buckens::fem
