// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/properties.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::mesh_io {

NastranProperties::NastranProperties(const NastranBulk& bulk, const NastranNames& names,
                                     const NastranCoordinates& coordinates,
                                     NastranMaterials& materials, NastranNotes& notes)
    : bulk_(&bulk),
      names_(&names),
      coordinates_(&coordinates),
      materials_(&materials),
      notes_(&notes) {
  const std::array<std::pair<const char*, Family>, 10> types = {{{"PSOLID", Family::solid},
                                                                 {"PSHELL", Family::shell},
                                                                 {"PCOMP", Family::shell},
                                                                 {"PCOMPG", Family::shell},
                                                                 {"PBAR", Family::bar},
                                                                 {"PBARL", Family::bar},
                                                                 {"PBEAM", Family::beam},
                                                                 {"PBEAML", Family::beam},
                                                                 {"PROD", Family::rod},
                                                                 {"CONROD", Family::conrod}}};
  for (const auto& [type, family] : types) {
    for (const NastranCard& card : bulk.cards_named(type)) {
      const auto [entry, is_new] = cards_[family].try_emplace(card.id(0), &card);
      if (is_new) continue;
      card.fail(fmt::format("there is another property with this number: {} in {}:{}",
                            entry->second->name, entry->second->file->name, entry->second->line));
    }
  }
}

int NastranProperties::of(const NastranElement& element,
                          const std::vector<Eigen::Vector3d>& nodes) {
  switch (element.kind) {
    case NastranElementKind::tria3:
    case NastranElementKind::triar:
    case NastranElementKind::quad4:
    case NastranElementKind::quadr:
      return shell(element, nodes);
    case NastranElementKind::bar:
      return line(element, Family::bar);
    case NastranElementKind::beam:
      return line(element, Family::beam);
    case NastranElementKind::rod:
      return line(element, Family::rod);
    case NastranElementKind::conrod:
      return line(element, Family::conrod);
    default:
      return solid(element);
  }
}

const NastranCard& NastranProperties::card_of(const NastranElement& element, Family family) const {
  const auto list = cards_.find(family);
  if (list != cards_.end()) {
    const auto entry = list->second.find(element.property);
    if (entry != list->second.end()) return *entry->second;
  }
  const char* const wanted = family == Family::solid   ? "PSOLID"
                             : family == Family::shell ? "PSHELL, PCOMP or PCOMPG"
                             : family == Family::bar   ? "PBAR or PBARL"
                             : family == Family::beam  ? "PBEAM or PBEAML"
                                                       : "PROD";
  throw InputError(element.place.where(),
                   fmt::format("{} {}: there is no {} {}", name_of(element.kind), element.id,
                               wanted, element.property));
}

std::string NastranProperties::name_of_card(const NastranCard& card) {
  const auto [entry, is_new] = card_names_.try_emplace(&card);
  if (is_new) {
    const std::string given = names_->property(card.id(0));
    const bool usable = !given.empty() && card.name != "CONROD" && !used_names_.contains(given);
    entry->second = usable ? given : card.label();
    used_names_.insert(entry->second);
  }
  return entry->second;
}

int NastranProperties::add(fem::ImportedProperty property, const More& more) {
  properties_.push_back(std::move(property));
  more_.push_back(more);
  return static_cast<int>(properties_.size()) - 1;
}

int NastranProperties::solid(const NastranElement& element) {
  const NastranCard& card = card_of(element, Family::solid);
  const auto found = plain_.find(&card);
  if (found != plain_.end()) return found->second;
  return plain_[&card] = add(convert_solid(card), {});
}

fem::ImportedProperty NastranProperties::convert_solid(const NastranCard& card) {
  const NastranPlace place{card.file, card.line};
  fem::ImportedProperty out;
  out.name = name_of_card(card);
  out.kind = fem::PropertyKind::solid;
  out.line = card.line;
  const std::int64_t material = card.id(1);
  out.material = materials_->name(material, NastranMaterials::Use::solid, card.label(), place);
  if (materials_->has_directions(material)) {
    const std::int64_t system = card.integer(2, 0);
    if (system < 0) card.fail(2, "CORDM = -1, axes of each element, is not supported");
    if (!coordinates_->is_rectangular(system, place)) {
      card.fail(2, "CORDM must be rectangular: the material has one direction per property");
    }
    out.axes = coordinates_->axes_at(system, Eigen::Vector3d::Zero(), place);
  }
  const std::string fluid = card.word(6);
  if (fluid == "PFLUID") card.fail(6, "fluid elements are not supported");
  for (const int field : {3, 5}) {
    if (card.blank(field) || card.text(field) == "0") continue;
    notes_->add(
        "PSOLID: the integration scheme (IN, ISOP) is left out; elements use that which "
        "the model file gives",
        place);
  }
  return out;
}

int NastranProperties::line(const NastranElement& element, Family family) {
  const NastranCard& card = card_of(element, family);
  const auto found = plain_.find(&card);
  if (found != plain_.end()) return found->second;
  const NastranPlace place{card.file, card.line};
  const bool is_beam = family == Family::bar || family == Family::beam;
  const NastranSection section =
      is_beam ? read_nastran_beam_section(card, *notes_) : read_nastran_rod_section(card, *notes_);
  fem::ImportedProperty out;
  out.name = name_of_card(card);
  out.kind = is_beam ? fem::PropertyKind::beam : fem::PropertyKind::bar;
  out.line = card.line;
  out.material =
      materials_->name(section.material, NastranMaterials::Use::line, card.label(), place);
  out.section = section.section;
  out.section->name = out.name;
  if (is_beam) out.shear_flexible = section.shear_flexible;
  return plain_[&card] = add(std::move(out), {section.mass_per_length, section.angle});
}

}  // namespace buckens::mesh_io
