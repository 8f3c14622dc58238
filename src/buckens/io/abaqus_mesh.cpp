// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/abaqus_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/nearest.h"

namespace buckens::io {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fem::PropertyKind;

namespace {

/// What elements of a section become: bars have solid sections in Abaqus.
bool fits(AbaqusRole role, PropertyKind section, PropertyKind& kind) {
  kind = section;
  if (role == AbaqusRole::bar && section == PropertyKind::solid) kind = PropertyKind::bar;
  return (role == AbaqusRole::solid && section == PropertyKind::solid) ||
         (role == AbaqusRole::shell && section == PropertyKind::shell) ||
         (role == AbaqusRole::beam && section == PropertyKind::beam) ||
         (role == AbaqusRole::bar && section == PropertyKind::solid);
}

const char* name_of(PropertyKind kind) {
  constexpr const char* names[] = {"*SOLID SECTION", "*SHELL SECTION", "*BEAM SECTION",
                                   "*SOLID SECTION"};
  return names[static_cast<std::size_t>(kind)];
}

bool is_kept(AbaqusRole role) {
  return role == AbaqusRole::solid || role == AbaqusRole::shell || role == AbaqusRole::beam ||
         role == AbaqusRole::bar;
}

}  // namespace

AbaqusMesh::AbaqusMesh(const AbaqusDeck& deck, const AbaqusLines& lines)
    : deck_(deck), lines_(lines), names_(deck, lines) {}

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
  note_element_types();
  add_abaqus_links(lines_, names_, out_);
  return std::move(out_);
}

fem::ImportNote AbaqusMesh::note_at(DeckPlace place, std::string text, int count) const {
  if (place.file > 0) text += fmt::format(" (in {})", lines_.where(place).file);
  return {std::move(text), place.line, count};
}

/// With several instances the names of their parts would meet.
std::string AbaqusMesh::prefixed(int scope, const std::string& name) const {
  if (scope == 0 || names_.scopes().size() <= 2) return name;
  return names_.scopes()[static_cast<std::size_t>(scope)].instance + "." + name;
}

void AbaqusMesh::add_nodes() {
  out_.positions = names_.positions();
  out_.node_ids = names_.labels();
  std::int64_t largest = 0;
  LabelIndex seen(out_.node_ids.size(), 0);
  bool meet = false;
  for (const std::int64_t label : out_.node_ids) {
    largest = std::max(largest, label);
    meet = seen.add(label, 1) >= 0 || meet;
  }
  if (!meet) return;
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

void AbaqusMesh::add_materials() {
  for (const auto& [key, material] : deck_.materials) {
    if (material.E > 0.0 || material.orthotropic) {
      materials_[key] = material.name;
      out_.materials.push_back(material);
      continue;
    }
    out_.notes.push_back({fmt::format("material \"{}\" has no *ELASTIC; its parts need a material "
                                      "from the model file",
                                      material.name),
                          material.where.line, 1});
    materials_[key] = "";
  }
}

std::string AbaqusMesh::material_called(const std::string& name, DeckPlace place) {
  if (name.empty()) return "";
  const auto found = materials_.find(upper(name));
  if (found != materials_.end()) return found->second;
  if (materials_.empty()) {
    out_.notes.push_back(note_at(place,
                                 fmt::format("material \"{}\" is not defined here; give it "
                                             "in the model file",
                                             name),
                                 1));
    return "";
  }
  std::vector<std::string> known;
  for (const auto& [key, written] : materials_) known.push_back(written);
  lines_.fail(place,
              fmt::format("there is no material \"{}\".{}", name, base::suggestion(name, known)));
}

const AbaqusOrientation* AbaqusMesh::orientation_called(int scope, const std::string& name,
                                                        DeckPlace place) const {
  if (name.empty()) return nullptr;
  for (const AbaqusScope* own :
       {names_.scopes()[static_cast<std::size_t>(scope)].scope, names_.scopes().front().scope}) {
    const auto found = own->orientations.find(upper(name));
    if (found != own->orientations.end()) return &found->second;
  }
  lines_.fail(place, fmt::format("there is no orientation \"{}\"", name));
}

void AbaqusMesh::assign_sections(int scope) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  auto& section_of = section_of_.emplace_back(static_cast<std::size_t>(placed.num_elements), -1);
  int replaced = 0;
  DeckPlace where;
  for (std::size_t k = 0; k < placed.scope->sections.size(); ++k) {
    const AbaqusSection& section = placed.scope->sections[k];
    for (const auto& at : names_.elements(scope, section.element_set, section.place)) {
      if (at.scope != scope) continue;
      const AbaqusElementType& type = *placed.at(at.element).first->type;
      if (!is_kept(type.role)) continue;
      PropertyKind kind;
      if (!fits(type.role, section.kind, kind)) {
        lines_.fail(section.place,
                    fmt::format("set \"{}\" holds elements of type {}, which have "
                                "no {}",
                                section.element_set, type.name, name_of(section.kind)));
      }
      int& entry = section_of[static_cast<std::size_t>(at.element)];
      if (entry >= 0) ++replaced;
      if (entry >= 0) where = section.place;
      entry = static_cast<int>(k);
    }
  }
  if (replaced == 0) return;
  out_.notes.push_back(
      note_at(where, "elements with two sections: the one that comes last is taken", replaced));
}

int AbaqusMesh::property_for(int scope, const AbaqusSection& section,
                             const AbaqusElementType& type) {
  PropertyKind kind;
  fits(type.role, section.kind, kind);
  // Axes turn with an instance; other properties are shared by those of a part.
  const bool is_own = !section.orientation.empty();
  const auto key = std::make_tuple(section.place.file, section.place.line, is_own ? scope : 0, kind,
                                   type.shear_flexible);
  const auto known = properties_.find(key);
  if (known != properties_.end()) return known->second;
  fem::ImportedProperty property;
  property.kind = kind;
  property.line = section.place.line;
  if (kind == PropertyKind::beam) property.shear_flexible = type.shear_flexible;
  property.name = section.element_set;
  const auto is_taken = [this](const std::string& name) {
    return std::any_of(out_.properties.begin(), out_.properties.end(),
                       [&](const auto& other) { return upper(other.name) == upper(name); });
  };
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  if (is_taken(property.name) && !placed.instance.empty()) {
    property.name = placed.instance + "." + section.element_set;
  }
  for (int k = 2; is_taken(property.name); ++k) {
    property.name = fmt::format("{} ({})", section.element_set, k);
  }
  fill_property(scope, section, property);
  out_.properties.push_back(std::move(property));
  return properties_[key] = static_cast<int>(out_.properties.size()) - 1;
}

void AbaqusMesh::fill_property(int scope, const AbaqusSection& section,
                               fem::ImportedProperty& property) {
  property.material = material_called(section.material, section.place);
  if (property.kind != PropertyKind::shell && deck_.laminae.contains(upper(section.material))) {
    lines_.fail(section.place,
                fmt::format("material \"{}\" is of TYPE=LAMINA, which is for shells; give all nine "
                            "ENGINEERING CONSTANTS",
                            section.material));
  }
  property.thickness = section.thickness;
  double thickness = section.thickness.value_or(0.0);
  for (const AbaqusSection::Layer& layer : section.layers) {
    if (!layer.orientation.empty()) {
      lines_.fail(layer.place, fmt::format("the layer has the orientation \"{}\"; give its angle "
                                           "in degrees instead",
                                           layer.orientation));
    }
    property.layers.push_back(
        {material_called(layer.material, layer.place), layer.thickness, layer.angle});
    thickness += layer.thickness;
  }
  // Abaqus counts from the middle to the nodes, we count from the nodes to the middle.
  property.offset = -section.offset * thickness;
  property.section = section.shape;
  if (property.kind == PropertyKind::bar) {
    fem::SectionSpec bar;
    bar.where = lines_.where(section.place);
    bar.shape = fem::CircleSpec{2.0 * std::sqrt(section.area / std::numbers::pi)};
    property.section = bar;
  }
  const AbaqusOrientation* axes = orientation_called(scope, section.orientation, section.place);
  if (axes == nullptr) return;
  const auto material = deck_.materials.find(upper(section.material));
  const bool is_isotropic =
      material != deck_.materials.end() && !material->second.orthotropic && section.layers.empty();
  if (axes->system == "RECTANGULAR") {
    Matrix3d own = names_.scopes()[static_cast<std::size_t>(scope)].rotation * axes->axes;
    if (section.kind == PropertyKind::shell) {
      if (!axes->normal && is_isotropic) return;
      if (!axes->normal) {
        lines_.fail(
            axes->place,
            fmt::format("orientation \"{}\" is used for shells, so its second line must say "
                        "which of its axes, 1, 2 or 3, is near their normal, and the angle "
                        "about it: \"3, 0.\" takes its axis 1 as direction 1",
                        axes->name));
      }
      // The axis after the one near the normal is projected onto the shell as direction 1.
      const Matrix3d given = own;
      for (int k = 0; k < 3; ++k) own.col(k) = given.col((*axes->normal + 1 + k) % 3);
    }
    property.axes = own;
    return;
  }
  if (is_isotropic) return;
  lines_.fail(section.place,
              fmt::format("orientation \"{}\" is of {}, which is supported for isotropic materials "
                          "only; give SYSTEM=RECTANGULAR, one section for each direction",
                          axes->name, axes->system));
}

void AbaqusMesh::add_elements(int scope) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  numbers_.emplace_back(static_cast<std::size_t>(placed.num_elements));
  for (int e = 0; e < placed.num_elements; ++e) {
    if (is_kept(placed.at(e).first->type->role)) add_element(scope, e);
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
    property = property_for(scope, section, *raw->type);
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
    for (std::size_t i = 0; i < length; ++i) block.nodes.push_back(nodes[piece + i]);
    sources_[entry->second].push_back({scope, element});
    if (raw->type->role != AbaqusRole::beam || property < 0) continue;
    block.up.push_back(up_direction(scope, element, nodes[piece], nodes[piece + 1]));
  }
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
    n1 = out_.positions[static_cast<std::size_t>(node)] - start;
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
    for (const auto& at : names_.elements(scope, mass.element_set, mass.place)) {
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
    // Also sets that are not handed on are looked at: they may refer to what is not there.
    auto nodes = names_.nodes(scope, set.name, set.parts.front().place);
    if (!set.is_internal) out_.node_sets.push_back({prefixed(scope, set.name), std::move(nodes)});
  }
  for (const auto& [key, set] : own.element_sets) {
    fem::ImportedElementSet entry{prefixed(scope, set.name), {}};
    for (const auto& at : names_.elements(scope, set.name, set.parts.front().place)) {
      const Numbers& numbers =
          numbers_[static_cast<std::size_t>(at.scope)][static_cast<std::size_t>(at.element)];
      for (int k = 0; k < numbers.count; ++k) entry.elements.push_back(numbers.first + k);
    }
    std::sort(entry.elements.begin(), entry.elements.end());
    if (!set.is_internal && !entry.elements.empty()) out_.element_sets.push_back(std::move(entry));
  }
}

void AbaqusMesh::add_surfaces(int scope) {
  const AbaqusScope& own = *names_.scopes()[static_cast<std::size_t>(scope)].scope;
  for (const auto& [key, surface] : own.surfaces) {
    const std::string name = prefixed(scope, surface.name);
    if (surface.is_of_nodes) {
      out_.node_sets.push_back({name, names_.surface_nodes(scope, surface.name, surface.place)});
      continue;
    }
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
      out_.node_sets.push_back({name, names_.surface_nodes(scope, surface.name, surface.place)});
    }
  }
}

void AbaqusMesh::note_element_types() {
  std::map<const AbaqusElementType*, std::pair<DeckPlace, int>> seen;
  std::map<const AbaqusElementType*, std::pair<DeckPlace, int>> bare;
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
      if (is_kept(block->type->role) && !has_section) count(bare);
    }
  }
  for (const auto& [type, entry] : seen) {
    const bool is_left_out = type->role == AbaqusRole::left_out;
    out_.notes.push_back(
        note_at(entry.first,
                fmt::format("{} {} {}", type->name, is_left_out ? "is" : "becomes", type->becomes),
                entry.second));
  }
  for (const auto& [type, entry] : bare) {
    out_.notes.push_back(note_at(entry.first,
                                 fmt::format("elements of type {} without a section", type->name),
                                 entry.second));
  }
}

}  // namespace buckens::io
