// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_ties.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/fem/assembly/recovery.h"

namespace buckens::model {

namespace {

/// Ties at the nodes of one divided body.
class TieMaker {
 public:
  TieMaker(const WholeBody& whole, const MeshDivision& division, MarkerFinder& find)
      : whole_(whole), find_(find), is_straight_(division.nodes.size(), false) {
    for (const int node : division.straight_nodes) {
      is_straight_[static_cast<std::size_t>(node)] = true;
    }
  }

  void tie_node(std::size_t node, const std::vector<fem::PartPlace>& copies) {
    std::vector<fem::PartPlace> turning, hinged;
    for (const fem::PartPlace& copy : copies) {
      (has_rotations(copy) ? turning : hinged).push_back(copy);
    }
    for (std::size_t k = 1; k < turning.size(); ++k) {
      tie(joints::JointType::fixed, turning[k - 1], turning[k]);
    }
    const fem::PartPlace root = turning.empty() ? hinged.front() : turning.front();
    for (const fem::PartPlace& copy : hinged) {
      if (copy.part == root.part) continue;
      if (is_straight_[node]) {
        tie_straight(root, copy);
      } else {
        tie(joints::JointType::spherical, root, copy);
      }
    }
  }

 private:
  const body::Body& body(const fem::PartPlace& copy) const {
    return find_.model().bodies[static_cast<std::size_t>(whole_.first + copy.part)];
  }

  bool has_rotations(const fem::PartPlace& copy) const {
    const auto& dofs =
        body(copy).flexible->mesh().dofs.node_dofs[static_cast<std::size_t>(copy.index)];
    return std::any_of(dofs.begin() + 3, dofs.end(), [](int dof) { return dof >= 0; });
  }

  MarkerId marker(const fem::PartPlace& copy) {
    MarkerId id;
    id.body = whole_.first + copy.part;
    id.marker = find_.table(id.body).cut_marker(copy.index);
    id.text = body(copy).name;
    return id;
  }

  Joint make(joints::JointType type, const fem::PartPlace& first, const fem::PartPlace& second) {
    Joint joint;
    joint.name = fmt::format("{}[{}-{}]", whole_.name, first.part + 1, second.part + 1);
    joint.type = type;
    joint.is_tie = true;
    joint.where = whole_.where;
    joint.first = marker(first);
    joint.second = marker(second);
    joint.first_row = find_.model().num_constraint_rows();
    return joint;
  }

  void tie(joints::JointType type, const fem::PartPlace& first, const fem::PartPlace& second) {
    Joint joint = make(type, first, second);
    joints::Placement placement = find_.placement(joint.first, joint.second);
    // Solids keep their variables across the plane of a planar model, and must not part there.
    const auto& dofs =
        body(first).flexible->mesh().dofs.node_dofs[static_cast<std::size_t>(first.index)];
    if (std::all_of(dofs.begin(), dofs.begin() + 3, [](int dof) { return dof >= 0; })) {
      placement.planar.reset();
    }
    joint.rows = joints::make_rows(type, placement);
    find_.model().joints.push_back(std::move(joint));
  }

  void tie_straight(const fem::PartPlace& first, const fem::PartPlace& second) {
    Joint joint = make(joints::JointType::fixed, first, second);
    joints::Placement placement = find_.placement(joint.first, joint.second);
    const fem::FeModel& fe = body(first).flexible->mesh();
    for (const fem::LineElement& line : fem::line_elements(fe)) {
      if (line.a != first.index && line.b != first.index) continue;
      placement.axis_F = fe.nodes[static_cast<std::size_t>(line.b)].position -
                         fe.nodes[static_cast<std::size_t>(line.a)].position;
    }
    joint.axis_F = joints::unit_axis(placement);
    joint.rows = joints::make_straight_rows(placement);
    find_.model().joints.push_back(std::move(joint));
  }

  const WholeBody& whole_;
  MarkerFinder& find_;
  std::vector<bool> is_straight_;
};

}  // namespace

void add_ties(const WholeBody& whole, const MeshDivision& division, MarkerFinder& find) {
  TieMaker maker(whole, division, find);
  for (std::size_t node = 0; node < division.nodes.size(); ++node) {
    if (division.nodes[node].size() > 1) maker.tie_node(node, division.nodes[node]);
  }
}

}  // namespace buckens::model
