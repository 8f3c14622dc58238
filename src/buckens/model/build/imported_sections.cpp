// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_sections.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

namespace {

bool section_fits(const fem::GroupSectionSpec& section, const fem::ImportedBlock& block) {
  return fem::dimension_of(block.kind) == (section.is_shell() ? 2 : 1);
}

/// Whether the file says all that an element needs besides its material.
bool has_own_section(const fem::ImportedMesh& mesh, const fem::ImportedBlock& block) {
  if (block.property < 0) return false;
  const auto& property = mesh.properties.at(static_cast<std::size_t>(block.property));
  return property.thickness || !property.layers.empty() || property.section;
}

}  // namespace

ImportedSections::ImportedSections(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given)
    : mesh_(mesh) {
  if (!given.section && given.sections.empty()) return;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    blocks_.insert(blocks_.end(), static_cast<std::size_t>(block.num_elements()), &block);
  }
  chosen_.assign(blocks_.size(), nullptr);
  if (given.section) choose_for_all(*given.section);
  for (const fem::GroupSectionSpec& section : given.sections) check(section);
  for (const fem::GroupSectionSpec& section : given.sections) choose_by_property(section);
  for (const fem::GroupSectionSpec& section : given.sections) choose_by_set(section);
}

void ImportedSections::choose_for_all(const fem::GroupSectionSpec& section) {
  for (std::size_t e = 0; e < blocks_.size(); ++e) {
    if (section_fits(section, *blocks_[e]) && !has_own_section(mesh_, *blocks_[e])) {
      chosen_[e] = &section;
    }
  }
}

void ImportedSections::choose_by_property(const fem::GroupSectionSpec& section) {
  for (std::size_t e = 0; e < blocks_.size(); ++e) {
    const fem::ImportedBlock& block = *blocks_[e];
    if (block.property < 0 || !section_fits(section, block)) continue;
    if (mesh_.properties.at(static_cast<std::size_t>(block.property)).name == section.name) {
      chosen_[e] = &section;
    }
  }
}

void ImportedSections::choose_by_set(const fem::GroupSectionSpec& section) {
  const auto* set = base::find_named(mesh_.element_sets, section.name);
  if (set == nullptr) return;
  for (const int element : set->elements) {
    const auto e = static_cast<std::size_t>(element);
    if (section_fits(section, *blocks_.at(e))) chosen_[e] = &section;
  }
}

void ImportedSections::check(const fem::GroupSectionSpec& section) const {
  const auto* set = base::find_named(mesh_.element_sets, section.name);
  const auto has_name = [&](const fem::ImportedBlock& block) {
    return block.property >= 0 &&
           mesh_.properties.at(static_cast<std::size_t>(block.property)).name == section.name;
  };
  const bool is_property = base::find_named(mesh_.properties, section.name) != nullptr;
  if (set == nullptr && !is_property) {
    std::vector<std::string> known;
    for (const auto& property : mesh_.properties) known.push_back(property.name);
    for (const auto& other : mesh_.element_sets) known.push_back(other.name);
    throw InputError(section.where,
                     fmt::format("{} has neither a property nor an element set \"{}\".{}",
                                 mesh_.file, section.name, base::suggestion(section.name, known)));
  }
  const bool fits_set =
      set != nullptr && std::any_of(set->elements.begin(), set->elements.end(), [&](int element) {
        return section_fits(section, *blocks_.at(static_cast<std::size_t>(element)));
      });
  const bool fits_property =
      std::any_of(mesh_.blocks.begin(), mesh_.blocks.end(), [&](const fem::ImportedBlock& block) {
        return has_name(block) && section_fits(section, block);
      });
  if (fits_set || fits_property) return;
  throw InputError(section.where,
                   fmt::format("{}: there are no {} in \"{}\" to which this section could apply",
                               mesh_.file, section.is_shell() ? "shells" : "lines", section.name));
}

}  // namespace buckens::model
