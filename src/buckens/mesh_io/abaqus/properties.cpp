// SPDX-License-Identifier: Apache-2.0
// Materials and sections of AbaqusMesh.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/mesh_io/abaqus/mesh.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
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

}  // namespace

void AbaqusMesh::add_materials() {
  for (const auto& [key, material] : deck_.materials) {
    materials_[key] = material.name;
    out_.materials.push_back(material);
    if (material.E > 0.0 || material.orthotropic) continue;
    out_.notes.push_back({fmt::format("material \"{}\" has no *ELASTIC; its parts need a material "
                                      "from the model file",
                                      material.name),
                          material.where.line, 1});
  }
}

std::string AbaqusMesh::material_called(const std::string& name, DeckPlace place) {
  if (name.empty()) return "";
  const auto found = materials_.find(upper(name));
  if (found != materials_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, written] : materials_) known.push_back(written);
  out_.notes.push_back(
      note_at(place,
              fmt::format("material \"{}\" is not defined here; give it in the "
                          "model file.{}",
                          name, known.empty() ? "" : base::suggestion(name, known)),
              1));
  // It has neither stiffness nor density, but a name under which the model file can give both.
  fem::MaterialSpec& material = out_.materials.emplace_back();
  material.name = name;
  material.where = lines_.where(place);
  return materials_[upper(name)] = name;
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
    for (const auto& at : names_.elements_of_set(scope, section.element_set, section.place)) {
      if (at.scope != scope) continue;
      const auto [block, place_in_block] = placed.at(at.element);
      const AbaqusElementType& type = *block->type;
      if (type.role == AbaqusRole::plane) {
        lines_.fail(block->places[place_in_block],
                    fmt::format("elements of type {} with a section are plane and cannot be part "
                                "of a three-dimensional body{}",
                                type.name, SkipList::remedy(type.name)));
      }
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
      note_at(where, "elements with two sections: the last one is used", replaced));
}

int AbaqusMesh::property_for(int scope, const AbaqusSection& section, int element) {
  const AbaqusElementType& type =
      *names_.scopes()[static_cast<std::size_t>(scope)].at(element).first->type;
  const OwnValues own = own_values(scope, section, element);
  PropertyKind kind;
  fits(type.role, section.kind, kind);
  // Axes turn with an instance; other properties are shared by those of a part.
  const bool is_own = !section.orientation.empty() || has_directed_layers(section);
  const auto key = std::make_tuple(section.place.file, section.place.line, is_own ? scope : 0, kind,
                                   type.shear_flexible, own.key());
  const auto known = properties_.find(key);
  if (known != properties_.end()) return known->second;
  fem::ImportedProperty property;
  property.kind = kind;
  property.line = section.place.line;
  if (kind == PropertyKind::beam) property.shear_flexible = type.shear_flexible;
  property.name = free_property_name(scope, section);
  fill_property(scope, section, own, property);
  property_names_.insert(upper(property.name));
  out_.properties.push_back(std::move(property));
  return properties_[key] = static_cast<int>(out_.properties.size()) - 1;
}

/// The name of the section's set, with the instance or a number if it is taken.
std::string AbaqusMesh::free_property_name(int scope, const AbaqusSection& section) {
  std::string out = section.element_set;
  const auto is_taken = [this](const std::string& name) {
    return property_names_.contains(upper(name));
  };
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  if (is_taken(out) && !placed.instance.empty()) out = placed.instance + "." + section.element_set;
  int& number = property_numbers_[section.element_set];
  for (number = std::max(number, 1); is_taken(out);) {
    out = fmt::format("{} ({})", section.element_set, ++number);
  }
  return out;
}

void AbaqusMesh::fill_property(int scope, const AbaqusSection& section, const OwnValues& own_values,
                               fem::ImportedProperty& property) {
  property.material = material_called(section.material, section.place);
  if (property.kind != PropertyKind::shell && deck_.laminae.contains(upper(section.material))) {
    lines_.fail(section.place,
                fmt::format("material \"{}\" is of TYPE=LAMINA, which is for shells; give all nine "
                            "ENGINEERING CONSTANTS",
                            section.material));
  }
  set_layers(section, own_values, property);
  property.section = section.shape;
  set_own_measures(section, own_values, property);
  if (property.kind == PropertyKind::bar) {
    fem::SectionSpec bar;
    bar.where = lines_.where(section.place);
    bar.shape = fem::CircleSpec{2.0 * std::sqrt(section.area / std::numbers::pi)};
    property.section = bar;
  }
  set_axes(scope, section, own_values, property);
  if (deck_.turned_materials.contains(upper(section.material))) turn_material(section, property);
}

void AbaqusMesh::set_layers(const AbaqusSection& section, const OwnValues& own_values,
                            fem::ImportedProperty& property) {
  property.thickness = section.thickness;
  double thickness = section.thickness.value_or(0.0);
  for (std::size_t k = 0; k < section.layers.size(); ++k) {
    const AbaqusSection::Layer& layer = section.layers[k];
    refuse_turned(layer.material, layer.place);
    property.layers.push_back({material_called(layer.material, layer.place), layer.thickness,
                               layer.orientation.empty() ? layer.angle : own_values.angles.at(k)});
    thickness += layer.thickness;
  }
  // Abaqus counts from the middle to the nodes, we count from the nodes to the middle.
  property.offset = -section.offset * thickness;
}

/// Of solids, from the orientation; of shells, so that the first is the shell's x axis once it is
/// projected.
void AbaqusMesh::set_axes(int scope, const AbaqusSection& section, const OwnValues& own_values,
                          fem::ImportedProperty& property) {
  const AbaqusOrientation* axes = reference_orientation(scope, section);
  if (axes == nullptr) return;
  const bool is_isotropic = has_no_directions(section);
  if (axes->system == "RECTANGULAR" || own_values.axes) {
    const Matrix3d own = names_.scopes()[static_cast<std::size_t>(scope)].rotation *
                         own_values.axes.value_or(Matrix3d::Identity()) * axes->axes;
    if (section.kind != PropertyKind::shell) {
      property.axes = own;
    } else if (axes->normal || !is_isotropic) {
      property.axes = in_order_of_shell(own, axes->normal.value_or(2));
    }
    return;
  }
  if (is_isotropic) return;
  lines_.fail(section.place,
              fmt::format("orientation \"{}\" is of {}, which is supported for isotropic materials "
                          "only; give SYSTEM=RECTANGULAR, one section for each direction",
                          axes->name, axes->system));
}

void AbaqusMesh::refuse_turned(const std::string& material, DeckPlace place) const {
  if (!deck_.turned_materials.contains(upper(material))) return;
  lines_.fail(place, fmt::format("material \"{}\" is of TYPE=ANISOTROPIC and couples stretch and "
                                 "shear, which is for solids only; give its ENGINEERING CONSTANTS, "
                                 "and their directions as *ORIENTATION",
                                 material));
}

/// A material whose planes of symmetry are turned from the axes of its constants has directions of
/// its own. In an orientation it becomes another one.
void AbaqusMesh::turn_material(const AbaqusSection& section, fem::ImportedProperty& property) {
  if (property.kind != PropertyKind::solid) refuse_turned(section.material, section.place);
  if (!property.axes) return;
  fem::MaterialSpec own = *base::find_named(out_.materials, property.material);
  own.orthotropic->axis_1 = *property.axes * own.orthotropic->axis_1;
  own.orthotropic->axis_2 = *property.axes * own.orthotropic->axis_2;
  own.name = fmt::format("{} in {}", own.name, property.name);
  property.axes.reset();
  property.material = own.name;
  out_.materials.push_back(std::move(own));
}

}  // namespace buckens::mesh_io
