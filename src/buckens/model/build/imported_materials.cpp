// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_materials.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model/build/spec_properties.h"

namespace buckens::model {

ImportedMaterials::ImportedMaterials(const fem::ImportedMesh& mesh,
                                     const fem::GroupMaterials& given,
                                     const std::optional<fem::DampingSpec>& damping,
                                     const SourceLocation& where)
    : mesh_(mesh),
      given_(given),
      damping_(damping),
      where_(where),
      by_set_(static_cast<std::size_t>(mesh.num_elements()), nullptr) {
  for (const fem::GroupMaterialSpec& group : given.materials) {
    const auto* set = base::find_named(mesh.element_sets, group.name);
    if (set != nullptr) {
      for (const int element : set->elements) {
        by_set_.at(static_cast<std::size_t>(element)) = &*group.material;
      }
    }
    if (set != nullptr || base::find_named(mesh.properties, group.name) != nullptr ||
        base::find_named(mesh.materials, group.name) != nullptr) {
      continue;
    }
    std::vector<std::string> known;
    for (const auto& property : mesh.properties) known.push_back(property.name);
    for (const auto& other : mesh.element_sets) known.push_back(other.name);
    for (const auto& other : mesh.materials) known.push_back(other.name);
    throw InputError(group.where,
                     fmt::format("{} has no property, element set or material \"{}\".{}", mesh.file,
                                 group.name, base::suggestion(group.name, known)));
  }
}

const fem::MaterialSpec* ImportedMaterials::named(const std::string& name) const {
  if (const auto* group = base::find_named(given_.materials, name)) return &*group->material;
  const fem::MaterialSpec* own = base::find_named(mesh_.materials, name);
  const bool is_elastic = own != nullptr && (own->E > 0.0 || own->orthotropic);
  return !is_elastic && given_.material ? &**given_.material : own;
}

const fem::MaterialSpec* ImportedMaterials::find(const fem::ImportedBlock& block,
                                                 int element) const {
  if (const auto* own = by_set_.at(static_cast<std::size_t>(element))) return own;
  if (block.property >= 0) {
    const auto& property = mesh_.properties.at(static_cast<std::size_t>(block.property));
    if (const auto* group = base::find_named(given_.materials, property.name)) {
      return &*group->material;
    }
    if (!property.material.empty()) return named(property.material);
  }
  return given_.material ? &**given_.material : nullptr;
}

void ImportedMaterials::refuse(const fem::ImportedBlock& block, const std::string& what) const {
  const std::string of =
      block.property < 0
          ? "without a property"
          : fmt::format("of \"{}\"",
                        mesh_.properties.at(static_cast<std::size_t>(block.property)).name);
  const std::string why =
      block.property < 0 ? ""
                         : mesh_.properties.at(static_cast<std::size_t>(block.property)).lacking;
  throw InputError(
      where_, fmt::format("{}: the {} elements {} {}{}; give `material`, or `materials` "
                          "by the name of the property or of an element set",
                          mesh_.file, block.source, of, what, why.empty() ? "" : " (" + why + ")"));
}

int ImportedMaterials::number_of(const fem::MaterialSpec& spec, int property) {
  const auto [entry, is_new] =
      numbers_.emplace(std::pair(&spec, property), static_cast<int>(materials_.size()));
  if (!is_new) return entry->second;
  fem::MaterialSpec own = spec;
  if (property >= 0) {
    const Eigen::Matrix3d& axes = *mesh_.properties[static_cast<std::size_t>(property)].axes;
    own.orthotropic->axis_1 = axes.col(0);
    own.orthotropic->axis_2 = axes.col(1);
  }
  materials_.push_back(make_material(own, damping_));
  return entry->second;
}

int ImportedMaterials::turning_property(const fem::ImportedBlock& block,
                                        const fem::MaterialSpec& spec) const {
  if (block.property < 0 || !spec.orthotropic) return -1;
  const auto& property = mesh_.properties[static_cast<std::size_t>(block.property)];
  const bool has_own = spec.orthotropic->axis_1 != Eigen::Vector3d::UnitX() ||
                       spec.orthotropic->axis_2 != Eigen::Vector3d::UnitY();
  const bool turns = property.kind == fem::PropertyKind::solid && property.axes && !has_own;
  return turns ? block.property : -1;
}

const fem::MaterialSpec& ImportedMaterials::spec(const fem::ImportedBlock& block,
                                                 int element) const {
  const fem::MaterialSpec* spec = find(block, element);
  if (spec == nullptr) refuse(block, "have no material");
  if (!(spec->E > 0.0) && !spec->orthotropic) {
    refuse(block, fmt::format("have the material \"{}\" without elastic constants", spec->name));
  }
  return *spec;
}

int ImportedMaterials::number(const fem::ImportedBlock& block, int element) {
  const fem::MaterialSpec& own = spec(block, element);
  return number_of(own, turning_property(block, own));
}

int ImportedMaterials::number(const std::string& name) {
  const fem::MaterialSpec* spec = named(name);
  if (spec == nullptr || (!(spec->E > 0.0) && !spec->orthotropic)) {
    throw InputError(where_, fmt::format("{}: material \"{}\" of a layer has no elastic constants; "
                                         "give it in the model file: materials: {{\"{}\": …}}",
                                         mesh_.file, name, name));
  }
  return number_of(*spec, -1);
}

}  // namespace buckens::model
