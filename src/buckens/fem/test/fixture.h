// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/structure.h"

namespace buckens::fem::test {

inline Material steel() {
  Material material = Material::isotropic(2.1e11, 0.3, 7850.0);
  return material;
}

/// A rectangle, so that section integrals can be taken by quadrature.
inline constexpr double kWidth = 0.03;
inline constexpr double kHeight = 0.05;
inline Section rectangle() { return Section::rectangle(kWidth, kHeight); }

inline BeamProperties beam_properties(BeamTheory theory, bool rotary) {
  BeamProperties properties = BeamProperties::of(steel(), rectangle(), theory);
  properties.rotary_inertia = rotary;
  return properties;
}

/// An L-shaped beam with arbitrary directions, a bracing bar and a point mass with inertia, turned
/// by `R`.
inline Structure frame_structure(const BeamProperties& given, const Eigen::Matrix3d& R) {
  Structure s;
  BeamProperties properties = given;
  properties.up = R * Eigen::Vector3d(0.2, -0.3, 1.0);
  const int a = add_node(s, "a", R * Eigen::Vector3d(0.1, 0.2, -0.1));
  const int b = add_node(s, "b", R * Eigen::Vector3d(0.7, 0.5, 0.3));
  const int c = add_node(s, "c", R * Eigen::Vector3d(0.9, -0.2, 0.5));
  add_beam(s, a, b, 2, properties);
  add_beam(s, b, c, 1, properties);
  const int d = add_node(s, "d", R * Eigen::Vector3d(0.2, -0.4, 0.6));
  for (const int node : {a, b, c}) s.bars.add(node, d, steel(), Section::circle(0.01));
  Eigen::Matrix3d inertia;
  inertia << 0.05, 0.004, -0.003, 0.004, 0.06, 0.002, -0.003, 0.002, 0.04;
  s.masses.add(c, 1.7, R * inertia * R.transpose());
  s.masses.add(d, 0.4);
  return s;
}

/// A rotation about a general axis.
inline Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}

/// Six rigid motions about the mass centre: unit translations, then unit rotations.
inline linalg::Matrix rigid_motions(const FeModel& fe) {
  linalg::Matrix Q = linalg::Matrix::Zero(fe.dofs.num_dofs, 6);
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Eigen::Vector3d x = fe.nodes[node].position - fe.shape.com;
    const auto& dofs = fe.dofs.node_dofs[node];
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(a);
      const Eigen::Vector3d turned = e.cross(x);
      for (int k = 0; k < 3; ++k) {
        const int u = dofs[static_cast<std::size_t>(k)];
        const int theta = dofs[static_cast<std::size_t>(3 + k)];
        if (u >= 0) Q(u, a) = e[k];
        if (u >= 0) Q(u, 3 + a) = turned[k];
        if (theta >= 0) Q(theta, 3 + a) = e[k];
      }
    }
  }
  return Q;
}

}  // namespace buckens::fem::test
