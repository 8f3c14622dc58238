// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/mesh.h"

#include <algorithm>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/field.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

AbaqusMesh::AbaqusMesh(const AbaqusDeck& deck, const AbaqusLines& lines)
    : deck_(deck),
      lines_(lines),
      names_(deck, lines),
      has_bodies_(has_any({AbaqusRole::solid, AbaqusRole::shell, AbaqusRole::beam})),
      has_planes_(has_any({AbaqusRole::plane})) {}

fem::ImportedMesh AbaqusMesh::run() {
  out_.file = lines_.where({0, 0}).file;
  out_.format = "Abaqus";
  out_.notes = deck_.notes;
  add_nodes();
  add_materials();
  const auto count = static_cast<int>(names_.scopes().size());
  for (int s = 0; s < count; ++s) assign_sections(s);
  for (int s = 0; s < count; ++s) add_elements(s);
  number_blocks();
  for (int s = 0; s < count; ++s) {
    add_masses(s);
    add_sets(s);
    add_surfaces(s);
  }
  add_instances();
  refuse_without_elements();
  note_element_types();
  add_abaqus_links(lines_, names_, out_);
  return std::move(out_);
}

fem::ImportNote AbaqusMesh::note_at(DeckPlace place, std::string text, int count) const {
  if (place.file > 0) text += fmt::format(" (in {})", lines_.where(place).file);
  return {std::move(text), place.line, count};
}

/// With several instances the names of their parts would clash.
std::string AbaqusMesh::prefixed(int scope, const std::string& name) const {
  if (scope == 0 || names_.scopes().size() <= 2) return name;
  return names_.scopes()[static_cast<std::size_t>(scope)].instance + "." + name;
}

/// Whether a number of a node or element stands in several instances.
bool AbaqusMesh::labels_meet() const {
  const auto& scopes = names_.scopes();
  const auto meet_in = [&](auto&& visit) {
    std::size_t count = 0;
    std::int64_t largest = 0;
    visit([&](std::int64_t label) {
      ++count;
      largest = std::max(largest, label);
    });
    LabelIndex seen(count, largest);
    bool meet = false;
    visit([&](std::int64_t label) { meet = seen.add(label, 1) >= 0 || meet; });
    return meet;
  };
  const auto visit_nodes = [&](auto&& use) {
    for (const std::int64_t label : out_.node_ids) use(label);
  };
  const auto visit_elements = [&](auto&& use) {
    for (const AbaqusPlaced& placed : scopes) {
      for (const AbaqusElements& block : placed.scope->elements) {
        for (const std::int64_t label : block.ids) use(label);
      }
    }
  };
  return scopes.size() > 1 && (meet_in(visit_nodes) || meet_in(visit_elements));
}

void AbaqusMesh::add_nodes() {
  out_.positions = names_.positions();
  out_.node_ids = names_.labels();
  if (!labels_meet()) return;
  std::int64_t largest = 0;
  for (const std::int64_t label : out_.node_ids) largest = std::max(largest, label);
  for (shift_ = 10; shift_ <= largest;) shift_ *= 10;
  const auto& scopes = names_.scopes();
  for (std::size_t s = 1; s < scopes.size(); ++s) {
    const std::int64_t add = shift_ * static_cast<std::int64_t>(s);
    for (int k = 0; k < scopes[s].num_nodes; ++k) {
      out_.node_ids[static_cast<std::size_t>(scopes[s].first_node + k)] += add;
    }
    out_.notes.push_back({fmt::format("nodes and elements of instance \"{}\" are numbered from {}: "
                                      "its node 12 is n{}",
                                      scopes[s].instance, add + 1, add + 12),
                          0, 1});
  }
}

bool AbaqusMesh::has_any(std::initializer_list<AbaqusRole> roles) const {
  for (const AbaqusPlaced& placed : names_.scopes()) {
    for (const AbaqusElements& block : placed.scope->elements) {
      const bool is_of_these =
          std::find(roles.begin(), roles.end(), block.type->role) != roles.end();
      if (is_of_these && !block.ids.empty()) return true;
    }
  }
  return false;
}

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
    out_.notes.push_back(
        note_at(place,
                "beams beside their nodes (OFFSET1, OFFSET2, unequal walls of a BOX) have "
                "nodes of their own on rigid links",
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

void AbaqusMesh::add_masses(int scope) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  std::set<int> used;
  for (const AbaqusMass& mass : placed.scope->masses) {
    Matrix3d axes = placed.rotation;
    if (const auto* own = orientation_called(scope, mass.orientation, mass.place)) {
      if (own->system != "RECTANGULAR") {
        lines_.fail(mass.place, "the inertia needs axes of SYSTEM=RECTANGULAR");
      }
      axes = placed.rotation * own->axes;
    }
    for (const auto& at : names_.elements_of_set(scope, mass.element_set, mass.place)) {
      const AbaqusRole role =
          names_.scopes()[static_cast<std::size_t>(at.scope)].at(at.element).first->type->role;
      if (role != (mass.is_rotary ? AbaqusRole::rotary_inertia : AbaqusRole::mass)) {
        lines_.fail(mass.place, fmt::format("set \"{}\" must hold elements of type {} only",
                                            mass.element_set, mass.is_rotary ? "ROTARYI" : "MASS"));
      }
      fem::ImportedMass& point = out_.masses.emplace_back();
      point.node = names_.element_nodes(at).front();
      point.mass = mass.mass;
      point.inertia = axes * mass.inertia * axes.transpose();
      if (at.scope == scope) used.insert(at.element);
    }
  }
  for (int e = 0; e < placed.num_elements; ++e) {
    const auto [block, k] = placed.at(e);
    const bool is_point =
        block->type->role == AbaqusRole::mass || block->type->role == AbaqusRole::rotary_inertia;
    if (!is_point || used.contains(e)) continue;
    lines_.fail(block->places[k],
                fmt::format("element {} of type {} has no {}", block->ids[k], block->type->name,
                            block->type->role == AbaqusRole::mass ? "*MASS" : "*ROTARY INERTIA"));
  }
}

void AbaqusMesh::add_sets(int scope) {
  const AbaqusScope& own = *names_.scopes()[static_cast<std::size_t>(scope)].scope;
  for (const auto& [key, set] : own.node_sets) {
    // Sets that are not passed on are checked as well: they may refer to missing things.
    auto nodes = names_.nodes(scope, set);
    if (!set.is_internal) out_.node_sets.push_back({prefixed(scope, set.name), std::move(nodes)});
  }
  for (const auto& [key, set] : own.element_sets) {
    fem::ImportedElementSet entry{prefixed(scope, set.name), {}};
    for (const auto& at : names_.elements(scope, set)) {
      const Numbers& numbers =
          numbers_[static_cast<std::size_t>(at.scope)][static_cast<std::size_t>(at.element)];
      for (int k = 0; k < numbers.count; ++k) entry.elements.push_back(numbers.first + k);
    }
    std::sort(entry.elements.begin(), entry.elements.end());
    if (!set.is_internal && !entry.elements.empty()) out_.element_sets.push_back(std::move(entry));
  }
}

/// With several instances each is an element set, so that one of them can be chosen.
void AbaqusMesh::add_instances() {
  const auto& scopes = names_.scopes();
  if (scopes.size() <= 2) return;
  for (std::size_t s = 1; s < scopes.size(); ++s) {
    if (base::find_named(out_.element_sets, scopes[s].instance) != nullptr) continue;
    fem::ImportedElementSet set{scopes[s].instance, {}};
    for (const Numbers& numbers : numbers_[s]) {
      for (int k = 0; k < numbers.count; ++k) set.elements.push_back(numbers.first + k);
    }
    std::sort(set.elements.begin(), set.elements.end());
    if (!set.elements.empty()) out_.element_sets.push_back(std::move(set));
  }
}

void AbaqusMesh::add_surfaces(int scope) {
  const AbaqusScope& own = *names_.scopes()[static_cast<std::size_t>(scope)].scope;
  const auto add_nodes_of = [&](const std::string& name, const AbaqusSurface& surface) {
    fem::ImportedNodeSet& set = out_.node_sets.emplace_back();
    set.name = name;
    for (const auto& [node, share] : names_.surface_nodes(scope, surface)) {
      set.nodes.push_back(node);
    }
  };
  for (const auto& [key, surface] : own.node_surfaces) {
    add_nodes_of(prefixed(scope, surface.name), surface);
  }
  for (const auto& [key, surface] : own.surfaces) {
    const std::string name = prefixed(scope, surface.name);
    fem::ImportedFaceSet entry{name, {}};
    bool has_edges = false;
    for (const AbaqusFace& face : names_.faces(scope, surface)) {
      has_edges = has_edges || face.is_edge;
      if (face.is_edge) continue;
      const Numbers& numbers =
          numbers_[static_cast<std::size_t>(face.scope)][static_cast<std::size_t>(face.element)];
      entry.faces.push_back({numbers.first, face.corners});
    }
    if (!entry.faces.empty()) {
      out_.face_sets.push_back(std::move(entry));
    } else if (has_edges) {
      add_nodes_of(name, surface);
    }
  }
}

void AbaqusMesh::note_element_types() {
  std::map<const AbaqusElementType*, std::pair<DeckPlace, int>> seen;
  std::map<const AbaqusElementType*, std::pair<DeckPlace, int>> bare, edges;
  const auto& scopes = names_.scopes();
  for (std::size_t s = 0; s < scopes.size(); ++s) {
    for (int e = 0; e < scopes[s].num_elements; ++e) {
      const auto [block, k] = scopes[s].at(e);
      const DeckPlace place = block->places[k];
      const auto count = [type = block->type, &place](auto& counts) {
        ++counts.try_emplace(type, place, 0).first->second.second;
      };
      if (!block->type->becomes.empty()) count(seen);
      const bool has_section = section_of_[s][static_cast<std::size_t>(e)] >= 0;
      const AbaqusRole role = role_of(static_cast<int>(s), e);
      if (is_kept(role) && !has_section) count(bare);
      if (block->type->role == AbaqusRole::bar && !is_kept(role)) count(edges);
    }
  }
  for (const auto& [type, entry] : seen) {
    const bool is_left_out = type->role == AbaqusRole::left_out || type->role == AbaqusRole::plane;
    out_.notes.push_back(
        note_at(entry.first,
                fmt::format("{} {} {}", type->name, is_left_out ? "is" : "becomes", type->becomes),
                entry.second));
  }
  for (const auto& [type, entry] : edges) {
    out_.notes.push_back(note_at(entry.first,
                                 fmt::format("{} without a section beside solids, shells or beams "
                                             "are left out; mesh generators write edges so",
                                             type->name),
                                 entry.second));
  }
  for (const auto& [type, entry] : bare) {
    out_.notes.push_back(note_at(entry.first,
                                 fmt::format("elements of type {} without a section", type->name),
                                 entry.second));
  }
}

}  // namespace buckens::mesh_io
