// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/nonstructural_mass.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace buckens::mesh_io {

NastranNonstructuralMass::NastranNonstructuralMass(const NastranBulk& bulk, bool has_control,
                                                   const std::optional<std::int64_t>& set,
                                                   NastranNotes& notes)
    : bulk_(bulk), notes_(notes) {
  const std::set<std::int64_t> sets = chosen_sets(has_control, set);
  for (const char* name : {"NSM", "NSM1", "NSML", "NSML1"}) {
    for (const NastranCard& card : bulk.cards_named(name)) {
      if (has_control && !sets.contains(card.id(0))) {
        notes.add(fmt::format("{}: left out; the case control does not ask for it (NSM = {})", name,
                              card.id(0)),
                  {card.file, card.line});
        continue;
      }
      const bool is_total = card.name.starts_with("NSML");
      if (card.name.back() == '1') {
        read_list(card, is_total);
      } else {
        read_pairs(card, is_total);
      }
    }
  }
}

/// What the case control asks for: one set, or those that NSMADD puts under its number.
std::set<std::int64_t> NastranNonstructuralMass::chosen_sets(
    bool has_control, const std::optional<std::int64_t>& set) const {
  std::set<std::int64_t> out;
  if (!has_control || !set) return out;
  out.insert(*set);
  for (const NastranCard& card : bulk_.cards_named("NSMADD")) {
    if (card.id(0) != *set) continue;
    for (int field = 1; field < card.size(); ++field) {
      if (!card.blank(field)) out.insert(card.id(field));
    }
  }
  return out;
}

NastranNonstructuralMass::Family NastranNonstructuralMass::family_of(const NastranCard& card) {
  static const std::map<std::string_view, Family> families = {
      {"PSHELL", Family::shell},  {"PCOMP", Family::shell}, {"PCOMPG", Family::shell},
      {"PBAR", Family::bar},      {"PBARL", Family::bar},   {"PBEAM", Family::beam},
      {"PBEAML", Family::beam},   {"PBCOMP", Family::beam}, {"PROD", Family::rod},
      {"CONROD", Family::conrod}, {"PTUBE", Family::tube},  {"ELEMENT", Family::element},
      {"PSHEAR", Family::none},   {"PRAC2D", Family::none}};
  const auto entry = families.find(card.word(1));
  if (entry == families.end()) {
    card.fail(1, fmt::format("expected the name of a property such as PSHELL, or ELEMENT, found "
                             "\"{}\"",
                             card.text(1)));
  }
  return entry->second;
}

NastranNonstructuralMass::Family NastranNonstructuralMass::family_of(NastranElementKind kind) {
  switch (kind) {
    case NastranElementKind::bar:
      return Family::bar;
    case NastranElementKind::beam:
      return Family::beam;
    case NastranElementKind::rod:
      return Family::rod;
    case NastranElementKind::tube:
      return Family::tube;
    case NastranElementKind::conrod:
      return Family::conrod;
    case NastranElementKind::tetra:
    case NastranElementKind::pyramid:
    case NastranElementKind::penta:
    case NastranElementKind::hexa:
      return Family::none;
    default:
      return Family::shell;
  }
}

/// SID, TYPE, then pairs of a number and its value.
void NastranNonstructuralMass::read_pairs(const NastranCard& card, bool is_total) {
  const Family family = family_of(card);
  for (int field = 2; field + 1 < card.size(); field += 2) {
    if (card.blank(field)) continue;
    shares_.push_back({&card, family, false, {card.id(field)}, card.real(field + 1), is_total});
  }
}

/// SID, TYPE, VALUE, then numbers, `1 THRU 9 BY 2`, or ALL.
void NastranNonstructuralMass::read_list(const NastranCard& card, bool is_total) {
  constexpr std::int64_t kMost = 1000000;
  Share share{&card, family_of(card), false, {}, card.real(2), is_total};
  for (int field = 3; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (card.word(field) == "ALL") {
      share.all = true;
    } else if (card.word(field) == "THRU") {
      const std::int64_t first = card.id(field - 1), last = card.id(field + 1);
      const bool has_step = card.word(field + 2) == "BY";
      const std::int64_t step = has_step ? card.id(field + 3) : 1;
      if (last - first > kMost) card.fail(field, "the range is too long");
      for (std::int64_t id = first; id <= last; id += step) share.ids.insert(id);
      field += has_step ? 3 : 1;
    } else {
      share.ids.insert(card.id(field));
    }
  }
  shares_.push_back(std::move(share));
}

void NastranNonstructuralMass::give(std::span<const int> corners, double mass) {
  for (const int node : corners) {
    masses_[node] += mass * bulk_.weight_to_mass / static_cast<double>(corners.size());
  }
}

void NastranNonstructuralMass::add(const NastranElement& element, std::span<const int> corners,
                                   double size, double density) {
  if (density != 0.0) {
    give(corners, density * size);
    notes_.add("non-structural mass NSM becomes point masses at the nodes", element.place);
  }
  if (shares_.empty()) return;
  members_.push_back({element.id,
                      element.property,
                      family_of(element.kind),
                      size,
                      {corners.begin(), corners.end()}});
}

void NastranNonstructuralMass::spread(const Share& share) {
  std::vector<const Member*> own;
  double size = 0;
  const auto take = [&](const std::vector<const Member*>& members) {
    own.insert(own.end(), members.begin(), members.end());
    for (const Member* member : members) size += member->size;
  };
  if (share.all) {
    for (const auto& [key, members] : places_) {
      if (key.first == share.family) take(members);
    }
  } else {
    for (const std::int64_t id : share.ids) {
      const auto entry = places_.find({share.family, id});
      if (entry != places_.end()) take(entry->second);
    }
  }
  if (own.empty()) {
    notes_.add(share.card->name + ": it names no shell or line element of this deck; left out",
               {share.card->file, share.card->line});
    return;
  }
  const double density = share.is_total ? share.value / size : share.value;
  for (const Member* member : own) give(member->corners, density * member->size);
  notes_.add(share.card->name + ": it becomes point masses at the nodes",
             {share.card->file, share.card->line});
}

void NastranNonstructuralMass::finish(fem::ImportedMesh& mesh) {
  for (const Member& member : members_) {
    if (member.family == Family::none) continue;
    places_[{member.family, member.property}].push_back(&member);
    places_[{Family::element, member.id}].push_back(&member);
  }
  for (const Share& share : shares_) spread(share);
  for (const auto& [node, mass] : masses_) {
    if (mass < 0) {
      shares_.front().card->fail(fmt::format(
          "non-structural masses add up to {:g} at a node; a mass cannot be negative", mass));
    }
    if (mass == 0.0) continue;
    fem::ImportedMass point;
    point.node = node;
    point.mass = mass;
    mesh.masses.push_back(point);
  }
}

}  // namespace buckens::mesh_io
