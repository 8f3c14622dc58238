// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/hinges.h"

#include <cmath>

namespace buckens::mesh_io {

namespace {

/// Equal components of two nodes along the rows of E. Solved for as many variables of the second
/// node, so that no equation holds a variable that another one eliminates.
void add_equalities(Eigen::MatrixXd E, int node, int hinge, int first, int line,
                    fem::ImportedMesh& mesh) {
  const Eigen::Index count = E.rows();
  std::array<bool, 3> is_taken{};
  std::vector<Eigen::Index> pivots;
  for (Eigen::Index row = 0; row < count; ++row) {
    Eigen::Index pivot = -1;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (is_taken[static_cast<std::size_t>(k)]) continue;
      if (pivot < 0 || std::abs(E(row, k)) > std::abs(E(row, pivot))) pivot = k;
    }
    is_taken[static_cast<std::size_t>(pivot)] = true;
    pivots.push_back(pivot);
    E.row(row) /= E(row, pivot);
    for (Eigen::Index other = 0; other < count; ++other) {
      if (other != row) E.row(other) -= E(other, pivot) * Eigen::RowVectorXd(E.row(row));
    }
  }
  for (Eigen::Index row = 0; row < count; ++row) {
    fem::ImportedEquation equation;
    equation.line = line;
    const auto pivot = static_cast<int>(pivots[static_cast<std::size_t>(row)]);
    equation.terms.push_back({hinge, first + pivot, 1.0});
    for (int k = 0; k < 3; ++k) {
      const double factor = E(row, k);
      if (std::abs(factor) < 1e-14) continue;  // rounding of orthonormal axes
      if (k != pivot) equation.terms.push_back({hinge, first + k, factor});
      equation.terms.push_back({node, first + k, -factor});
    }
    mesh.equations.push_back(std::move(equation));
  }
}

}  // namespace

void tie_nastran_nodes(int node, int follower, const Eigen::Matrix3d& axes,
                       const std::array<bool, 6>& released, const std::string& name, int line,
                       fem::ImportedMesh& mesh) {
  fem::ImportedRigidLink link;
  link.name = name;
  link.reference = node;
  link.nodes = {follower};
  link.line = line;
  link.variables = {};
  bool has_link = false;
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    Eigen::MatrixXd kept(0, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      if (released[first + k]) continue;
      kept.conservativeResize(kept.rows() + 1, 3);
      kept.bottomRows(1) = axes.col(static_cast<Eigen::Index>(k)).transpose();
    }
    if (kept.rows() == 3) {
      has_link = true;
      for (std::size_t k = 0; k < 3; ++k) link.variables[first + k] = true;
    } else if (kept.rows() > 0) {
      add_equalities(kept, node, follower, static_cast<int>(first), line, mesh);
    }
  }
  if (has_link) mesh.rigid_links.push_back(std::move(link));
}

int add_nastran_hinge(int node, const Eigen::Matrix3d& axes, const std::array<bool, 6>& released,
                      const std::string& name, int line, NastranCoordinates& coordinates,
                      fem::ImportedMesh& mesh) {
  const Eigen::Vector3d place = coordinates.positions()[static_cast<std::size_t>(node)];
  const int hinge = coordinates.add_node(place);
  tie_nastran_nodes(node, hinge, axes, released, name, line, mesh);
  return hinge;
}

}  // namespace buckens::mesh_io
