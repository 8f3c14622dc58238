// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/point/spring_block.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

// Entries below this share of the largest are rounding.
constexpr double kAsymmetry = 1e-12;

using Lever = Eigen::Matrix<double, 6, 12>;  // Δ from the twelve variables of both nodes

Lever lever(const std::vector<Node>& nodes, const std::array<int, 2>& ends) {
  const Vector3d a = nodes[static_cast<std::size_t>(ends[0])].position;
  const Vector3d b = nodes[static_cast<std::size_t>(ends[1])].position;
  const Vector3d half = 0.5 * (b - a);  // from a to the middle; the middle lies at −half from b
  Lever out = Lever::Zero();
  out.leftCols<6>().diagonal().setConstant(-1.0);
  out.rightCols<6>().diagonal().setConstant(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d turned = Vector3d::Unit(axis).cross(half);
    out.col(3 + axis).head<3>() = -turned;
    out.col(9 + axis).head<3>() = -turned;
  }
  return out;
}

std::array<int, 12> dofs_of(const DofMap& dofs, const std::array<int, 2>& ends) {
  std::array<int, 12> out{};
  for (std::size_t end = 0; end < 2; ++end) {
    const auto& node = dofs.node_dofs[static_cast<std::size_t>(ends[end])];
    std::copy(node.begin(), node.end(), out.begin() + static_cast<std::ptrdiff_t>(6 * end));
  }
  return out;
}

}  // namespace

int SpringBlock::add(int node_a, int node_b, const Stiffness& stiffness) {
  elements_.push_back({{node_a, node_b}, stiffness});
  return num_elements() - 1;
}

void SpringBlock::check(const MeshView& mesh) const {
  for (const auto& [ends, stiffness] : elements_) {
    const auto where = [&, a = ends[0], b = ends[1]] {
      return fmt::format("spring between {} and {}", node_label(mesh.nodes, a),
                         node_label(mesh.nodes, b));
    };
    if (ends[0] == ends[1]) {
      throw ModelError(
          fmt::format("spring at {}: both ends are the same node; it holds nothing, "
                      "remove it",
                      node_label(mesh.nodes, ends[0])));
    }
    const double size = stiffness.cwiseAbs().maxCoeff();
    const bool is_finite = stiffness.allFinite();
    const Eigen::VectorXd eigenvalues = linalg::symmetric_eigenvalues(stiffness);
    if (!is_finite || (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size ||
        eigenvalues[0] < -1e-9 * eigenvalues[5]) {
      throw ModelError(where() +
                       ": its stiffness must be a symmetric matrix without negative eigenvalues");
    }
    const Lever full = lever(mesh.nodes, ends);
    const Eigen::Matrix<double, 12, 12> K = full.transpose() * stiffness * full;
    const auto dofs = dofs_of(mesh.dofs, ends);
    const bool is_planar =
        mesh.dofs.node_dofs.empty() ? false : dofs[0] < 0 || dofs[1] < 0 || dofs[2] < 0;
    for (Eigen::Index k = 0; k < 12 && !is_planar; ++k) {
      if (dofs[static_cast<std::size_t>(k)] >= 0) continue;
      if (K.col(k).cwiseAbs().maxCoeff() <= kAsymmetry * K.cwiseAbs().maxCoeff()) continue;
      throw ModelError(fmt::format(
          "{}: it turns {}, which has no rotations since only solids or bars are there; use nodes "
          "at one place and translations only, or give the node a beam, shell or rigid link",
          where(), node_label(mesh.nodes, ends[k < 6 ? 0 : 1])));
    }
  }
}

void SpringBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  for (const auto& [ends, stiffness] : elements_) {
    const Lever full = lever(mesh.nodes, ends);
    Eigen::Matrix<double, 12, 12> K = full.transpose() * stiffness * full;
    K = (0.5 * (K + K.transpose())).eval();
    scatter<12>(K, dofs_of(mesh.dofs, ends), 1.0, sum.K);
  }
}

PointRows SpringBlock::point_rows(const MeshView& mesh, int element, double /*xi*/) const {
  throw ModelError(fmt::format("spring {} at {}: only beams and bars have a place along them",
                               element + 1, node_label(mesh.nodes, at(element).ends[0])));
}

}  // namespace buckens::fem
