// SPDX-License-Identifier: Apache-2.0
// Elements of a deck and where they lie.
#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/field.h"
#include "buckens/mesh_io/abaqus/mesh.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

AbaqusRole AbaqusMesh::role_of(int scope, int element) const {
  const auto s = static_cast<std::size_t>(scope);
  const AbaqusRole role = names_.scopes()[s].at(element).first->type->role;
  const bool has_section = section_of_[s][static_cast<std::size_t>(element)] >= 0;
  if (role == AbaqusRole::plane) return has_bodies_ ? AbaqusRole::left_out : AbaqusRole::shell;
  if (role == AbaqusRole::bar && !has_section && (has_bodies_ || has_planes_)) {
    return AbaqusRole::left_out;
  }
  return role;
}

/// Without any element there is no body; with those of other kinds that needs saying.
void AbaqusMesh::refuse_without_elements() const {
  if (out_.num_elements() > 0 || !out_.masses.empty()) return;
  std::map<std::string_view, int> counts;
  const AbaqusElements* first = nullptr;
  for (const AbaqusPlaced& placed : names_.scopes()) {
    for (const AbaqusElements& block : placed.scope->elements) {
      if (block.ids.empty()) continue;
      counts[block.type->name] += static_cast<int>(block.ids.size());
      if (first == nullptr) first = &block;
    }
  }
  if (first == nullptr) return;
  std::string types;
  for (const auto& [name, count] : counts) {
    types += fmt::format("{}{} {}", types.empty() ? "" : ", ", count, name);
  }
  lines_.fail(first->places.front(),
              fmt::format("no element of this deck can be part of a flexible body: {}; it needs "
                          "solids, shells, beams or bars",
                          types));
}

void AbaqusMesh::add_elements(int scope) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  numbers_.emplace_back(static_cast<std::size_t>(placed.num_elements));
  for (int e = 0; e < placed.num_elements; ++e) {
    if (is_kept(role_of(scope, e))) add_element(scope, e);
  }
}

void AbaqusMesh::add_element(int scope, int element) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  const auto [raw, k] = placed.at(element);
  const int section_number =
      section_of_[static_cast<std::size_t>(scope)][static_cast<std::size_t>(element)];
  int property = -1;
  if (section_number >= 0) {
    const auto& section = placed.scope->sections[static_cast<std::size_t>(section_number)];
    property = property_for(scope, section, element);
  }
  const auto [entry, is_new] = block_of_.try_emplace({raw->type, property}, out_.blocks.size());
  if (is_new) {
    fem::ImportedBlock& block = out_.blocks.emplace_back();
    const bool is_split = raw->type->kind == fem::CellKind::line3;
    block.kind = is_split ? fem::CellKind::line2 : raw->type->kind;
    block.source = std::string(raw->type->name);
    block.property = property;
    sources_.emplace_back();
  }
  fem::ImportedBlock& block = out_.blocks[entry->second];
  const std::vector<int> nodes = names_.element_nodes({scope, element});
  // A quadratic line, whose middle node stands second, becomes two straight ones.
  const std::size_t pieces = raw->type->kind == fem::CellKind::line3 ? 2 : 1;
  const std::size_t length = pieces == 2 ? 2 : nodes.size();
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    block.ids.push_back(raw->ids[k] + shift_ * scope);
    sources_[entry->second].push_back({scope, element});
    const bool has_shape = raw->type->role == AbaqusRole::beam && property >= 0;
    if (has_shape) block.up.push_back(up_direction(scope, element, nodes[piece], nodes[piece + 1]));
    Vector3d shift = Vector3d::Zero();
    if (has_shape) {
      const auto& section = placed.scope->sections[static_cast<std::size_t>(section_number)];
      Vector3d& up = block.up.back();
      shift = shift_of(section, nodes[piece], nodes[piece + 1], up);
      up = turned_up(section, nodes[piece], nodes[piece + 1], up);
    }
    for (std::size_t i = 0; i < length; ++i) {
      block.nodes.push_back(shifted_node(nodes[piece + i], shift, raw->places[k]));
    }
  }
}

/// From the nodes of a beam to the centre of its section. @param up direction 2
Vector3d AbaqusMesh::shift_of(const AbaqusSection& section, int a, int b,
                              const Vector3d& up) const {
  if (section.shift.isZero(0.0)) return Vector3d::Zero();
  const Vector3d along =
      out_.positions[static_cast<std::size_t>(b)] - out_.positions[static_cast<std::size_t>(a)];
  return section.shift[0] * up.cross(along.normalized()) + section.shift[1] * up;
}

/// The second axis of a section that is turned about the beam. @param up direction 2
Vector3d AbaqusMesh::turned_up(const AbaqusSection& section, int a, int b,
                               const Vector3d& up) const {
  if (section.turn == 0.0) return up;
  const Vector3d along =
      out_.positions[static_cast<std::size_t>(b)] - out_.positions[static_cast<std::size_t>(a)];
  return Eigen::AngleAxisd(section.turn, along.normalized()) * up;
}

/// The node itself, or one beside it that follows it as a rigid body.
int AbaqusMesh::shifted_node(int node, const Vector3d& shift, DeckPlace place) {
  if (shift.isZero(0.0)) return node;
  const auto [entry, is_new] = shifted_.try_emplace({node, {shift.x(), shift.y(), shift.z()}}, 0);
  if (!is_new) return entry->second;
  if (shifted_.size() == 1) {
    free_label_ = *std::max_element(out_.node_ids.begin(), out_.node_ids.end());
    out_.notes.push_back(note_at(place,
                                 "beams offset from their nodes (OFFSET1, OFFSET2, unequal walls "
                                 "of a BOX) get additional nodes on rigid links",
                                 1));
  }
  const Vector3d position = out_.positions[static_cast<std::size_t>(node)] + shift;
  out_.positions.push_back(position);
  out_.node_ids.push_back(++free_label_);
  entry->second = static_cast<int>(out_.positions.size()) - 1;
  fem::ImportedRigidLink link;
  link.name = fmt::format("offset {}", free_label_);
  link.reference = node;
  link.nodes = {entry->second};
  link.line = place.line;
  out_.rigid_links.push_back(std::move(link));
  return entry->second;
}

/// Direction 2 of the section, t × n1.
Vector3d AbaqusMesh::up_direction(int scope, int element, int a, int b) const {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  const auto [raw, k] = placed.at(element);
  const Vector3d& start = out_.positions[static_cast<std::size_t>(a)];
  const Vector3d t = out_.positions[static_cast<std::size_t>(b)] - start;
  const int number =
      section_of_[static_cast<std::size_t>(scope)][static_cast<std::size_t>(element)];
  Vector3d n1 = placed.rotation * placed.scope->sections[static_cast<std::size_t>(number)].n1;
  if (raw->direction_nodes[k] >= 0) {
    const int node = placed.nodes.find(raw->direction_nodes[k]);
    if (node < 0) {
      lines_.fail(raw->places[k], fmt::format("element {} refers to node {} for its direction n1, "
                                              "which is not defined",
                                              raw->ids[k], raw->direction_nodes[k]));
    }
    const auto stride = static_cast<std::size_t>(raw->type->num_nodes);
    const int first = placed.nodes.find(raw->nodes[k * stride]);
    n1 = out_.positions[static_cast<std::size_t>(node)] -
         out_.positions[static_cast<std::size_t>(first)];
  }
  const Vector3d up = t.cross(n1);
  // The sine of the angle that numbers written with six digits can tell from zero.
  if (up.norm() > 1e-6 * t.norm() * n1.norm()) return up.normalized();
  lines_.fail(
      raw->places[k],
      fmt::format("direction n1 of beam {} lies along the beam, or its nodes coincide; give "
                  "another n1 in its *BEAM SECTION",
                  raw->ids[k]));
}

void AbaqusMesh::number_blocks() {
  int next = 0;
  for (const auto& block : sources_) {
    for (const AbaqusElementAt& at : block) {
      Numbers& numbers =
          numbers_[static_cast<std::size_t>(at.scope)][static_cast<std::size_t>(at.element)];
      if (numbers.count++ == 0) numbers.first = next;
      ++next;
    }
  }
}

}  // namespace buckens::mesh_io
