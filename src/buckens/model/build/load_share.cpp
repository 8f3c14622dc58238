// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/load_share.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "buckens/fem/assembly/uniform_shares.h"
#include "buckens/fem/shell/shares.h"

namespace buckens::model {

using Eigen::Vector3d;

const fem::FeModel& LoadShares::mesh_of(int body) const {
  return model_.bodies[static_cast<std::size_t>(body)].flexible->mesh();
}

fem::PartPlace LoadShares::place_of(const std::vector<fem::PartPlace> MeshDivision::*list,
                                    int element) const {
  if (division_ == nullptr) return {0, element};
  return (division_->*list)[static_cast<std::size_t>(element)];
}

int LoadShares::node_in(int part, int node) const {
  if (division_ == nullptr) return node;
  const auto& copies = division_->nodes[static_cast<std::size_t>(node)];
  return std::find_if(copies.begin(), copies.end(),
                      [&](const fem::PartPlace& copy) { return copy.part == part; })
      ->index;
}

void LoadShares::add_node(int body, int own_node, double share, LoadShare& to) const {
  const fem::FeModel& fe = mesh_of(body);
  const auto k = static_cast<std::size_t>(own_node);
  to.first_moment += share * fe.nodes[k].position;
  for (int axis = 0; axis < 3; ++axis) {
    to.rows.emplace_back(axis, fe.dofs.node_dofs[k][static_cast<std::size_t>(axis)], share);
  }
}

void LoadShares::add_face(const fem::ElementFace& face) {
  const fem::Structure& structure = mesh_.structure;
  add_integrals(fem::face_integrals(structure.solids, structure.nodes, face),
                place_of(&MeshDivision::solids, face.element).part);
}

void LoadShares::add_side(const fem::ShellSide& side) {
  const fem::Structure& structure = mesh_.structure;
  const int number = structure.solids.num_elements() + side.element;
  add_integrals(fem::shell_side_integrals(structure.shells, structure.nodes, side),
                place_of(&MeshDivision::solids, number).part);
}

void LoadShares::add_shell(int element, bool per_mass) {
  const fem::Structure& structure = mesh_.structure;
  const fem::ShellShares own =
      fem::shell_shares(structure.shells, structure.nodes, element, per_mass);
  const int part = place_of(&MeshDivision::solids, structure.solids.num_elements() + element).part;
  const fem::FeModel& fe = mesh_of(whole_.first + part);
  LoadShare& share = shares_[whole_.first + part];
  share.extent += own.translation.sum();
  for (Eigen::Index k = 0; k < own.translation.size(); ++k) {
    const int node = node_in(part, own.nodes[static_cast<std::size_t>(k)]);
    add_node(whole_.first + part, node, own.translation[k], share);
    const Vector3d arm = own.arm.col(k);
    share.first_moment += arm;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d turned = Vector3d::Unit(axis).cross(arm);
      const int dof =
          fe.dofs.node_dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(3 + axis)];
      for (int row = 0; row < 3; ++row) {
        if (turned[row] != 0.0) share.rows.emplace_back(row, dof, turned[row]);
      }
    }
  }
}

void LoadShares::add_integrals(const fem::FaceIntegrals& own, int part) {
  const int body = whole_.first + part;
  LoadShare& share = shares_[body];
  share.extent += own.area.sum();
  LoadFoot foot{Vector3d::Zero(), own.nodes.front(), -own.normal.rowwise().sum().normalized()};
  for (Eigen::Index k = 0; k < own.area.size(); ++k) {
    const int node = node_in(part, own.nodes[static_cast<std::size_t>(k)]);
    const auto n = static_cast<std::size_t>(node);
    add_node(body, node, own.area[k], share);
    foot.place += own.area[k] / own.area.sum() * mesh_of(body).nodes[n].position;
    const Vector3d normal = own.normal.col(k);
    share.normals += normal;
    share.moments += mesh_of(body).nodes[n].position.cross(normal);
    for (int axis = 0; axis < 3; ++axis) {
      const int dof = mesh_of(body).dofs.node_dofs[n][static_cast<std::size_t>(axis)];
      share.normal_row.emplace_back(0, dof, normal[axis]);
    }
  }
  share.feet.push_back(foot);
}

void LoadShares::add_solid(int element, double density) {
  const fem::NodeShares own =
      fem::solid_shares(mesh_.structure.solids, mesh_.structure.nodes, element);
  const int part = place_of(&MeshDivision::solids, element).part;
  LoadShare& share = shares_[whole_.first + part];
  share.extent += density * own.share.sum();
  for (Eigen::Index k = 0; k < own.share.size(); ++k) {
    add_node(whole_.first + part, node_in(part, own.nodes[static_cast<std::size_t>(k)]),
             density * own.share[k], share);
  }
}

void LoadShares::add_line(int line, const fem::Quartic& density) {
  const fem::PartPlace place = place_of(&MeshDivision::lines, line);
  const int body = whole_.first + place.part;
  const fem::LineIntegral own = fem::line_integral(mesh_of(body), place.index, density);
  const fem::Structure& whole = mesh_.structure;
  const int beams = whole.beams.num_elements();
  const int end = line < beams ? whole.beams.ends(line)[0] : whole.bars.ends(line - beams)[0];
  LoadShare& share = shares_[body];
  share.extent += own.extent;
  share.first_moment += own.first_moment;
  share.feet.push_back({own.middle, end, Vector3d::Zero()});
  share.rows.insert(share.rows.end(), own.rows.begin(), own.rows.end());
}

}  // namespace buckens::model
