// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/mesh.h"

#include <algorithm>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/field.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;

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
                                             "are left out; mesh generators write edges this way",
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
