// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/hex8_block.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/node_label.h"
#include "buckens/fem/scatter.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using Dofs = std::array<int, 24>;

Dofs element_dofs(const DofMap& map, const std::array<int, 8>& nodes) {
  Dofs out{};
  for (std::size_t i = 0; i < 8; ++i) {
    const auto& node = map.node_dofs[static_cast<std::size_t>(nodes[i])];
    std::copy_n(node.begin(), 3, out.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return out;
}

/// Where each face has its corners, counter-clockwise seen from outside.
constexpr std::array<std::array<std::size_t, 4>, 6> kFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

void check_material(const std::string& where, const Material& m) {
  if (!(m.E > 0.0 && m.nu > -1.0 && m.nu < 0.5 && m.rho >= 0.0)) {
    throw ModelError(
        fmt::format("{}: E = {:g} Pa, nu = {:g}, rho = {:g} kg/m³; a solid needs E > 0, "
                    "-1 < nu < 0.5 and rho >= 0 (use 0.49 for rubber)",
                    where, m.E, m.nu, m.rho));
  }
  const double G = m.E / (2.0 * (1.0 + m.nu));
  if (std::abs(m.G - G) > 1e-6 * G) {
    throw ModelError(fmt::format(
        "{}: G = {:g} Pa, but an isotropic solid with this E and nu has {:g} Pa; leave `G` out",
        where, m.G, G));
  }
}

}  // namespace

int Hex8Block::add_material(const Material& material) {
  materials_.push_back(material);
  return static_cast<int>(materials_.size()) - 1;
}

int Hex8Block::add(const std::array<int, 8>& nodes, int material) {
  elements_.push_back({nodes, material});
  return num_elements() - 1;
}

Hex8Corners Hex8Block::corners(const std::vector<Node>& nodes, const Element& element) {
  Hex8Corners out;
  for (int i = 0; i < 8; ++i) {
    const int node = element.nodes[static_cast<std::size_t>(i)];
    out.col(i) = nodes[static_cast<std::size_t>(node)].position;
  }
  return out;
}

Hex8Block Hex8Block::subset(const std::vector<int>& elements,
                            const std::vector<int>& node_numbers) const {
  Hex8Block out;
  std::vector<int> number(materials_.size(), -1);
  for (const int e : elements) {
    Element element = at(e);
    int& own = number[static_cast<std::size_t>(element.material)];
    if (own < 0) own = out.add_material(materials_[static_cast<std::size_t>(element.material)]);
    for (int& node : element.nodes) node = node_numbers.at(static_cast<std::size_t>(node));
    out.add(element.nodes, own);
  }
  return out;
}

void Hex8Block::check(const MeshView& mesh) const {
  for (int e = 0; e < num_elements(); ++e) {
    const Element& element = at(e);
    const Hex8Corners x = corners(mesh.nodes, element);
    const double size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
    const double least = hex8_least_volume(x);
    const auto where = [&] {
      return fmt::format("solid element {} between {} and {}", e + 1,
                         node_label(mesh.nodes, element.nodes[0]),
                         node_label(mesh.nodes, element.nodes[6]));
    };
    // Jacobians are eighths of volumes; one part in 1e12 of the bounding cube is flat.
    if (!(8.0 * least > 1e-12 * size * size * size)) {
      throw ModelError(fmt::format(
          "{}: its Jacobian falls to {:.3g} m³, so it is turned inside out or squashed flat; list "
          "the nodes of the lower face counter-clockwise seen from above, then those of the upper "
          "face in the same order, or move a node",
          where(), least));
    }
    check_material(where(), *material(e));
  }
}

void Hex8Block::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    const Hex8Corners x = corners(nodes, at(e));
    const Eigen::Matrix<double, 8, 1> share =
        material(e)->rho * hex8_volume_products(x).rowwise().sum();
    sum.mass += share.sum();
    sum.first += x * share;
  }
}

void Hex8Block::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    const Element& element = at(e);
    if (material(e)->rho == 0.0) continue;
    const Hex8Corners x = corners(mesh.nodes, element);
    const Eigen::Matrix<double, 8, 8> Ms = material(e)->rho * hex8_volume_products(x);
    scatter<8>(Ms, element.nodes, 1.0, sum.nodal);
    const Hex8Corners x0 = x.colwise() - com;
    const Eigen::Matrix<double, 3, 8> moment = x0 * Ms;  // Σ_J Ms_IJ x0_J
    const Dofs dofs = element_dofs(mesh.dofs, element.nodes);
    for (int node = 0; node < 8; ++node) {
      for (int b = 0; b < 3; ++b) {
        const int dof = dofs[static_cast<std::size_t>(3 * node + b)];
        if (dof < 0) continue;
        for (int a = 0; a < 3; ++a) sum.c(dof, 3 * a + b) += moment(a, node);
      }
    }
    const Eigen::Matrix3d second = moment * x0.transpose();
    sum.C0 += 0.5 * (second + second.transpose());
  }
}

void Hex8Block::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  sum.K.reserve(sum.K.size() + 576 * elements_.size());
  for (int e = 0; e < num_elements(); ++e) {
    const Material& m = *material(e);
    const auto K = hex8_stiffness(corners(mesh.nodes, at(e)), solid_elasticity(m.E, m.nu));
    const Dofs dofs = element_dofs(mesh.dofs, at(e).nodes);
    scatter<24>(K, dofs, 1.0, sum.K);
    if (m.damping_stiffness != 0.0) scatter<24>(K, dofs, m.damping_stiffness, sum.K_damping);
  }
}

void Hex8Block::add_force_rows(const MeshView& /*mesh*/, int /*first_element*/,
                               std::vector<linalg::Triplet>& /*rows*/) const {}

PointRows Hex8Block::point_rows(const MeshView& mesh, int element, double /*xi*/) const {
  throw ModelError(fmt::format("solid element {} at {}: only lines have a place along them",
                               element + 1, node_label(mesh.nodes, at(element).nodes[0])));
}

void Hex8Block::add_stress_rows(const MeshView& mesh, int first_element,
                                std::vector<linalg::Triplet>& rows) const {
  for (int e = 0; e < num_elements(); ++e) {
    const Material& m = *material(e);
    const Hex8Point centre = hex8_point(corners(mesh.nodes, at(e)), Vector3d::Zero());
    const Eigen::Matrix<double, 6, 24> stress = solid_elasticity(m.E, m.nu) * hex8_strain(centre);
    const Dofs dofs = element_dofs(mesh.dofs, at(e).nodes);
    for (int j = 0; j < 24; ++j) {
      const int column = dofs[static_cast<std::size_t>(j)];
      for (int i = 0; i < 6 && column >= 0; ++i) {
        if (stress(i, j) == 0.0) continue;
        rows.emplace_back(6 * (first_element + e) + i, column, stress(i, j));
      }
    }
  }
}

std::vector<std::array<int, 4>> Hex8Block::faces(int element) const {
  const auto& nodes = at(element).nodes;
  std::vector<std::array<int, 4>> out;
  for (const auto& face : kFaces) {
    out.push_back({nodes[face[0]], nodes[face[1]], nodes[face[2]], nodes[face[3]]});
  }
  return out;
}

}  // namespace buckens::fem
