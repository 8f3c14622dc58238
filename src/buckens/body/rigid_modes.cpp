// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/rigid_modes.h"

#include <array>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/node_label.h"

namespace buckens::body {

using Eigen::Vector3d;
using linalg::Matrix;

namespace {
constexpr double kStrainTolerance = 1e-9;

int node_of_dof(const fem::DofMap& dofs, Eigen::Index dof) {
  for (std::size_t node = 0; node < dofs.node_dofs.size(); ++node) {
    for (const int candidate : dofs.node_dofs[node]) {
      if (candidate == dof) return static_cast<int>(node);
    }
  }
  return -1;
}

/// What is left of the stiffness of six variables is rounding.
[[noreturn]] void refuse_rigid(const std::string& body, const fem::FeModel& fe) {
  const Vector3d& com = fe.shape.com;
  throw ModelError(fmt::format(
      "body \"{}\": rigid links hold all of its nodes together, so it cannot deform; give it as "
      "`rigid: {{mass: {:.6g} kg, com: [{:.6g}, {:.6g}, {:.6g}], inertia: …}}`, or take nodes out "
      "of the links",
      body, fe.shape.mass, com[0], com[1], com[2]));
}

}  // namespace

Matrix rigid_modes(const std::vector<Vector3d>& node_positions, const fem::DofMap& dofs,
                   const Vector3d& com) {
  Matrix Phi = Matrix::Zero(dofs.num_dofs, 6);
  for (std::size_t node = 0; node < node_positions.size(); ++node) {
    const Vector3d x0 = node_positions[node] - com;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d turned = Vector3d::Unit(axis).cross(x0);
      for (int component = 0; component < 3; ++component) {
        const int translation = dofs.node_dofs[node][static_cast<std::size_t>(component)];
        if (translation < 0) continue;
        if (component == axis) Phi(translation, axis) = 1.0;
        Phi(translation, 3 + axis) = turned[component];
      }
      const int rotation = dofs.node_dofs[node][static_cast<std::size_t>(3 + axis)];
      if (rotation >= 0) Phi(rotation, 3 + axis) = 1.0;
    }
  }
  return Phi;
}

void check_stiffness_is_free(const std::string& body, const linalg::SymmetricMatrix& K,
                             const Matrix& Phi, const fem::FeModel& fe) {
  static const std::array<const char*, 6> names = {
      "translation x", "translation y", "translation z", "rotation x", "rotation y", "rotation z"};
  const double stiffness = K.norm();
  for (int mode = 0; mode < 6; ++mode) {
    const linalg::Vector residual = K * Phi.col(mode);
    const double limit = kStrainTolerance * stiffness * Phi.col(mode).norm();
    if (residual.norm() <= limit) continue;
    if (fe.dofs.num_dofs == 6) refuse_rigid(body, fe);
    Eigen::Index worst = 0;
    residual.cwiseAbs().maxCoeff(&worst);
    throw ModelError(fmt::format(
        "body \"{}\": the rigid {} strains its mesh (|K q| = {:.3g}, largest at {}); a spring to "
        "ground or an element that resists rigid motion is inside the body: take it out and attach "
        "it by a joint or a load",
        body, names[static_cast<std::size_t>(mode)], residual.norm(),
        fem::node_label(fe.nodes, node_of_dof(fe.dofs, worst))));
  }
}

}  // namespace buckens::body
