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
  const std::array<std::pair<const char*, Family>, 11> types = {{{"PSOLID", Family::solid},
                                                                 {"PSHELL", Family::shell},
                                                                 {"PCOMP", Family::shell},
                                                                 {"PCOMPG", Family::shell},
                                                                 {"PBAR", Family::bar},
                                                                 {"PBARL", Family::bar},
                                                                 {"PBEAM", Family::beam},
                                                                 {"PBEAML", Family::beam},
                                                                 {"PROD", Family::rod},
                                                                 {"PTUBE", Family::tube},
                                                                 {"CONROD", Family::conrod}}};
  for (const auto& [type, family] : types) {
    for (const NastranCard& card : bulk.cards_named(type)) add_card(card, cards_[family]);
  }
  // In NASTRAN-95 each card has numbers of its own.
  for (const char* type : {"PIHEX", "PQUAD1", "PQUAD2", "PQDMEM", "PQDMEM1", "PQDMEM2", "PTRIA1",
                           "PTRIA2", "PTRMEM"}) {
    for (const NastranCard& card : bulk.cards_named(type)) add_card(card, old_cards_[type]);
  }
}

void NastranProperties::add_card(const NastranCard& card, Cards& cards) {
  const auto [entry, is_new] = cards.try_emplace(card.id(0), &card);
  if (is_new) return;
  card.fail(fmt::format("there is another property with this number: {} in {}:{}",
                        entry->second->name, entry->second->file->name, entry->second->line));
}

int NastranProperties::of(const NastranElement& element,
                          const std::vector<Eigen::Vector3d>& nodes) {
  switch (element.kind) {
    case NastranElementKind::tria3:
    case NastranElementKind::triar:
    case NastranElementKind::quad4:
    case NastranElementKind::quadr:
    case NastranElementKind::tria6:
    case NastranElementKind::quad8:
      return shell(element, nodes);
    case NastranElementKind::bar:
      return line(element, Family::bar);
    case NastranElementKind::beam:
      return line(element, Family::beam);
    case NastranElementKind::rod:
      return line(element, Family::rod);
    case NastranElementKind::tube:
      return line(element, Family::tube);
    case NastranElementKind::conrod:
      return line(element, Family::conrod);
    default:
      return solid(element);
  }
}

const NastranCard* NastranProperties::card_of(const NastranElement& element, Family family) const {
  const Cards* cards = nullptr;
  if (element.property_card != nullptr) {
    const auto list = old_cards_.find(element.property_card);
    if (list != old_cards_.end()) cards = &list->second;
  } else if (const auto list = cards_.find(family); list != cards_.end()) {
    cards = &list->second;
  }
  if (cards == nullptr) return nullptr;
  const auto entry = cards->find(element.property);
  return entry == cards->end() ? nullptr : entry->second;
}

/// A property without a card: solids of NASTRAN-95 have a material in its place, all others are
/// left to the model file.
int NastranProperties::missing(const NastranElement& element, Family family) {
  const auto found = without_card_.find({family, element.property});
  if (found != without_card_.end()) return found->second;
  const char* const card = element.property_card != nullptr ? element.property_card
                           : family == Family::solid        ? "PSOLID"
                           : family == Family::shell        ? "PSHELL"
                           : family == Family::bar          ? "PBAR"
                           : family == Family::beam         ? "PBEAM"
                           : family == Family::tube         ? "PTUBE"
                                                            : "PROD";
  fem::ImportedProperty out;
  out.name = unique_name(fmt::format("{} {}", card, element.property));
  out.kind = family == Family::solid                           ? fem::PropertyKind::solid
             : family == Family::shell                         ? fem::PropertyKind::shell
             : family == Family::bar || family == Family::beam ? fem::PropertyKind::beam
                                                               : fem::PropertyKind::bar;
  out.line = element.place.line;
  out.along_first_side = out.kind == fem::PropertyKind::shell;
  const bool is_material =
      family == Family::solid && materials_->has(element.property) &&
      (element.property_card != nullptr || bulk_->cards_named("PSOLID").empty());
  if (is_material) {
    out.material = materials_->name(element.property, NastranMaterials::Use::solid,
                                    name_of(element.kind), element.place);
    notes_->add(fmt::format("{}: there is no PSOLID; the number is taken as that of a material, as "
                            "in NASTRAN-95",
                            name_of(element.kind)),
                element.place);
  } else {
    out.lacking = fmt::format("the deck has no {} {}", card, element.property);
    notes_->add(fmt::format("{}; the model file must say what it is", out.lacking), element.place);
  }
  return without_card_[{family, element.property}] = add(std::move(out), {});
}

std::string NastranProperties::unique_name(const std::string& wanted) {
  std::string name = wanted;
  for (int k = 2; !used_names_.insert(name).second; ++k) name = fmt::format("{} ({})", wanted, k);
  return name;
}

std::string NastranProperties::name_of_card(const NastranCard& card) {
  const auto [entry, is_new] = card_names_.try_emplace(&card);
  if (is_new) {
    const std::string given = names_->property(card.id(0));
    const bool usable = !given.empty() && card.name != "CONROD" && !used_names_.contains(given);
    entry->second = unique_name(usable ? given : card.label());
  }
  return entry->second;
}

int NastranProperties::add(fem::ImportedProperty property, const More& more) {
  properties_.push_back(std::move(property));
  more_.push_back(more);
  return static_cast<int>(properties_.size()) - 1;
}

int NastranProperties::solid(const NastranElement& element) {
  const NastranCard* const card = card_of(element, Family::solid);
  if (card == nullptr) return missing(element, Family::solid);
  const auto found = plain_.find(card);
  if (found != plain_.end()) return found->second;
  return plain_[card] = add(convert_solid(*card), {});
}

fem::ImportedProperty NastranProperties::convert_solid(const NastranCard& card) {
  const NastranPlace place{card.file, card.line};
  fem::ImportedProperty out;
  out.name = name_of_card(card);
  out.kind = fem::PropertyKind::solid;
  out.line = card.line;
  const std::int64_t material = card.id(1);
  set_material(material, NastranMaterials::Use::solid, card, out);
  if (!out.material.empty() && materials_->has_directions(material)) {
    const std::int64_t system = card.integer(2, 0);
    if (system < 0) card.fail(2, "CORDM = -1, axes of each element, is not supported");
    if (!coordinates_->is_rectangular(system, place)) {
      card.fail(2, "CORDM must be rectangular: the material has one direction per property");
    }
    out.axes = coordinates_->axes_at(system, Eigen::Vector3d::Zero(), place);
    if (materials_->is_turned(out.material) && !out.axes->isIdentity(1e-12)) {
      card.fail(2, fmt::format("CORDM = {} with a MAT9 that couples tension and shear is not "
                               "supported; give the 21 constants in the basic system",
                               system));
    }
  }
  const std::string fluid = card.word(6);
  if (fluid == "PFLUID") card.fail(6, "fluid elements are not supported");
  for (const int field : {3, 5}) {
    if (card.blank(field) || card.text(field) == "0") continue;
    notes_->add(
        "PSOLID: the integration scheme (IN, ISOP) is left out; elements use the scheme given in "
        "the model file",
        place);
  }
  return out;
}

/// The material, or why it is left to the model file.
void NastranProperties::set_material(std::int64_t material, NastranMaterials::Use use,
                                     const NastranCard& card, fem::ImportedProperty& out) {
  const NastranPlace place{card.file, card.line};
  out.lacking = materials_->lack(material, use, card.label());
  if (out.lacking.empty()) {
    out.material = materials_->name(material, use, card.label(), place);
  } else {
    notes_->add(fmt::format("{}; the model file must give the material", out.lacking), place);
  }
}

int NastranProperties::line(const NastranElement& element, Family family) {
  const NastranCard* const found_card = card_of(element, family);
  if (found_card == nullptr) return missing(element, family);
  const NastranCard& card = *found_card;
  const auto found = plain_.find(&card);
  if (found != plain_.end()) return found->second;
  const bool is_frame = family == Family::bar || family == Family::beam;
  const NastranSection section =
      is_frame ? read_nastran_beam_section(card, *notes_) : read_nastran_rod_section(card, *notes_);
  const bool is_beam = is_frame && !section.is_bar;
  fem::ImportedProperty out;
  out.name = name_of_card(card);
  out.kind = is_beam ? fem::PropertyKind::beam : fem::PropertyKind::bar;
  out.line = card.line;
  set_material(section.material, is_beam ? NastranMaterials::Use::beam : NastranMaterials::Use::bar,
               card, out);
  if (section.lacking.empty()) {
    out.section = section.section;
    out.section->name = out.name;
  } else {
    out.lacking = section.lacking;
    notes_->add(fmt::format("{}; the model file must give the section", section.lacking),
                {card.file, card.line});
  }
  if (is_beam) out.shear_flexible = section.shear_flexible;
  return plain_[&card] =
             add(std::move(out), {section.mass_per_length, section.angle, section.offset});
}

}  // namespace buckens::mesh_io
