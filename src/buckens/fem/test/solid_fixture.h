// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/fem/solid/shape.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {

inline const std::vector<SolidForm>& all_forms() {
  static const std::vector<SolidForm> all = {
      {SolidKind::hex8, SolidIntegration::full}, SolidForm::usual(SolidKind::hex8),
      SolidForm::usual(SolidKind::hex20),        SolidForm::usual(SolidKind::tet4),
      SolidForm::usual(SolidKind::tet10),        SolidForm::usual(SolidKind::wedge6),
      SolidForm::usual(SolidKind::wedge15),      SolidForm::usual(SolidKind::pyramid5)};
  return all;
}

/// Name of a test for a form.
inline std::string form_name(const SolidForm& form) {
  std::string name = choice_names(form.kind)[static_cast<std::size_t>(form.kind)];
  const bool full = form.integration == SolidIntegration::full;
  return form.kind == SolidKind::hex8 ? name + (full ? "_full" : "_incompatible") : name;
}

inline bool is_quadratic(const SolidForm& form) {
  return form.kind == SolidKind::hex20 || form.kind == SolidKind::tet10 ||
         form.kind == SolidKind::wedge15;
}

/// n×n×n points of the shape of a kind.
inline QuadratureRule fine_rule(SolidKind kind, int n) {
  const SolidTopology& topology = solid_topology(kind);
  if (topology.is_hexahedron()) return cube_rule(n);
  if (topology.is_tetrahedron()) return conical_rule(n);
  return topology.is_wedge() ? wedge_rule(n) : pyramid_rule(n);
}

/// Moves every node a little, so that no element keeps plane faces or straight edges.
inline void distort(Structure& s, double reach) {
  for (std::size_t k = 0; k < s.nodes.size(); ++k) {
    const double t = static_cast<double>(k);
    s.nodes[k].position +=
        reach * Eigen::Vector3d(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t + 1));
  }
}

/// A 2×2×2 block of 0.4 × 0.3 × 0.2 m with all its nodes displaced.
inline Structure distorted_block(const SolidForm& form, const Material& material = steel()) {
  Structure s;
  add_box(s, {{0.1, -0.2, 0.3}, {0.4, 0.3, 0.2}, {2, 2, 2}}, material, form);
  distort(s, is_quadratic(form) ? 0.004 : 0.01);
  return s;
}

/// Nodes that are not on any named face.
inline std::vector<int> inner_nodes(const Structure& s) {
  std::vector<bool> outside(s.nodes.size(), false);
  for (const FaceSet& set : s.face_sets) {
    for (const int node : face_set_nodes(s.solids, set.faces)) {
      outside[static_cast<std::size_t>(node)] = true;
    }
  }
  std::vector<int> out;
  for (std::size_t k = 0; k < outside.size(); ++k) {
    if (!outside[k]) out.push_back(static_cast<int>(k));
  }
  return out;
}

/// Nodal variables of a displacement field in a mesh of solids.
template <class Field>
linalg::Vector nodal_values(const FeModel& fe, Field&& field) {
  linalg::Vector d(fe.dofs.num_dofs);
  for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
    d.segment<3>(fe.dofs.node_dofs[k][0]) = field(fe.nodes[k].position);
  }
  return d;
}

}  // namespace buckens::fem::test
