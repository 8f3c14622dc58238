// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/element_cards.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "buckens/mesh_io/nastran/number.h"
#include "buckens/mesh_io/nastran/rigid_elements.h"

namespace buckens::mesh_io {

namespace {

using Kind = NastranElementKind;

std::optional<Kind> kind_named(std::string_view name) {
  if (!name.starts_with('C')) return std::nullopt;
  for (int i = 0; i <= static_cast<int>(Kind::conrod); ++i) {
    if (name == name_of(static_cast<Kind>(i))) return static_cast<Kind>(i);
  }
  return std::nullopt;
}

/// Elements of NASTRAN-95 that have a successor.
struct OldElement {
  std::string_view name;
  Kind kind;
  const char* property;    ///< card of its property, "MAT1" if it has a material in its place
  const char* difference;  ///< for the note, "" if there is none worth telling
};

const OldElement* old_element(std::string_view name) {
  static constexpr const char* kMembrane = ", with bending stiffness, which it did not have";
  static constexpr std::array<OldElement, 13> all = {
      {{"CQUAD1", Kind::quad4, "PQUAD1", ""},
       {"CQUAD2", Kind::quad4, "PQUAD2", ""},
       {"CQDMEM", Kind::quad4, "PQDMEM", kMembrane},
       {"CQDMEM1", Kind::quad4, "PQDMEM1", kMembrane},
       {"CQDMEM2", Kind::quad4, "PQDMEM2", kMembrane},
       {"CTRIA1", Kind::tria3, "PTRIA1", ""},
       {"CTRIA2", Kind::tria3, "PTRIA2", ""},
       {"CTRMEM", Kind::tria3, "PTRMEM", kMembrane},
       {"CWEDGE", Kind::penta, "MAT1", ""},
       {"CHEXA1", Kind::hexa, "MAT1", ""},
       {"CHEXA2", Kind::hexa, "MAT1", ""},
       {"CIHEX1", Kind::hexa, "PIHEX", ""},
       {"CIHEX2", Kind::hexa, "PIHEX", ""}}};
  const auto* const found =
      std::find_if(all.begin(), all.end(), [&](const OldElement& old) { return old.name == name; });
  return found == all.end() ? nullptr : found;
}

bool is_without_node(const NastranCard& card, int field) {
  return card.blank(field) || card.text(field) == "0";
}

/// Adds the nodes in the fields from `first` on. Behind the corners a blank or 0 is a mid-side node
/// that is left out. @throws InputError if one stands there twice
void add_nodes(const NastranCard& card, int first, int count, int corners, NastranBulk& bulk,
               NastranElement& element) {
  element.first_node = static_cast<std::uint32_t>(bulk.element_nodes.size());
  element.num_nodes = count;
  for (int i = 0; i < count; ++i) {
    if (i >= corners && is_without_node(card, first + i)) {
      bulk.element_nodes.push_back(NastranBulk::kNoNode);
      continue;
    }
    const std::int64_t node = card.id(first + i);
    const auto begin = bulk.element_nodes.begin() + element.first_node;
    if (std::find(begin, bulk.element_nodes.end(), node) != bulk.element_nodes.end()) {
      card.fail(first + i, fmt::format("node {} appears there twice", node));
    }
    bulk.element_nodes.push_back(node);
  }
}

/// Corners alone, or all nodes, some of which may be left out.
int num_solid_nodes(const NastranCard& card, int corners, int all) {
  int num_mid = 0;
  for (int i = 2 + corners; i < 2 + all; ++i) num_mid += is_without_node(card, i) ? 0 : 1;
  if (card.size() > 2 + all) {
    card.fail(2 + all, fmt::format("too many nodes; there are {} at most", all));
  }
  if (num_mid == 0) return corners;
  return all;
}

void read_solid(const NastranCard& card, NastranBulk& bulk, NastranElement& element) {
  struct Count {
    int corners, all;
  };
  const Count count = element.kind == Kind::tetra     ? Count{4, 10}
                      : element.kind == Kind::pyramid ? Count{5, 13}
                      : element.kind == Kind::penta   ? Count{6, 15}
                                                      : Count{8, 20};
  add_nodes(card, 2, num_solid_nodes(card, count.corners, count.all), count.corners, bulk, element);
  if (card.name != "CIHEX2" || element.num_nodes != 20) return;
  // It lists nodes around the lower face, those of upright edges, and around the upper face.
  static constexpr std::array<std::size_t, 20> kOrder = {0, 2, 4, 6, 12, 14, 16, 18, 1,  3,
                                                         5, 7, 8, 9, 10, 11, 13, 15, 17, 19};
  const auto nodes = bulk.element_nodes.begin() + element.first_node;
  const std::vector<std::int64_t> written(nodes, nodes + 20);
  for (std::size_t i = 0; i < 20; ++i) nodes[static_cast<std::ptrdiff_t>(i)] = written[kOrder[i]];
}

/// Where a shell card has what, counted behind its name.
struct ShellFields {
  int corners, nodes;
  int theta;      ///< angle or system, the offset behind it
  int flag;       ///< TFLAG
  int thickness;  ///< at the first corner
};

ShellFields shell_fields(Kind kind) {
  switch (kind) {
    case Kind::tria6:
      return {3, 6, 8, 13, 10};
    case Kind::quad8:
      return {4, 8, 14, 16, 10};
    case Kind::tria3:
      return {3, 3, 5, 9, 10};
    default:
      return {4, 4, 6, 9, 10};
  }
}

void read_shell(const NastranCard& card, NastranBulk& bulk, NastranElement& element,
                NastranNotes& notes) {
  if (element.kind == Kind::triar || element.kind == Kind::quadr) {
    element.kind = element.kind == Kind::triar ? Kind::tria3 : Kind::quad4;
    notes.add(fmt::format("{}: taken as {}", card.name, name_of(element.kind)), element.place);
  }
  const ShellFields at = shell_fields(element.kind);
  int given = 0;
  for (int i = at.corners; i < at.nodes; ++i) given += is_without_node(card, 2 + i) ? 0 : 1;
  if (at.nodes > at.corners && given == 0) {  // all sides are straight
    element.kind = element.kind == Kind::tria6 ? Kind::tria3 : Kind::quad4;
    notes.add(
        fmt::format("{} without mid-side nodes: taken as {}", card.name, name_of(element.kind)),
        element.place);
  }
  add_nodes(card, 2, given == 0 ? at.corners : at.nodes, at.corners, bulk, element);
  NastranShellDetails details;
  if (!card.blank(at.theta)) {
    details.has_system = card.is_integer(at.theta);
    if (details.has_system) details.system = card.integer(at.theta);
    if (!details.has_system) details.theta = card.real(at.theta);
    if (details.system < 0) card.fail(at.theta, "there are no such coordinate systems");
  }
  details.offset = card.real(at.theta + 1, 0.0);
  details.relative = card.integer(at.flag, 0) == 1;
  bool any = false;
  for (int i = 0; i < at.corners; ++i) any = any || !card.blank(at.thickness + i);
  for (int i = 0; any && i < at.corners; ++i) {
    const int field = at.thickness + i;
    if (card.blank(field)) {
      details.thickness.emplace_back();
      continue;
    }
    const double thickness = card.real(field);
    if (thickness < 0) card.fail(field, fmt::format("the thickness {:g} is negative", thickness));
    details.thickness.emplace_back(thickness);
  }
  if (card.blank(at.theta) && card.blank(at.theta + 1) && !any) return;
  element.details = static_cast<std::int32_t>(bulk.shells.size());
  bulk.shells.push_back(std::move(details));
}

/// PA and PB. A beam that may turn about its own axis at both ends would spin: it is held at the
/// first.
void read_pins(const NastranCard& card, NastranLineDetails& line) {
  for (const std::size_t end : {0, 1}) {
    const int field = 8 + static_cast<int>(end);
    if (card.text(field) != "0") line.pins[end] = read_nastran_variables(card, field);
  }
  if (line.pins[1][3]) line.pins[0][3] = false;
}

/// OFFT: one letter each for the orientation vector and the offsets of both ends; G: system of the
/// node, B (for the vector): basic system, O: axes of the beam. NASTRAN-95 has F there: 1 for a
/// vector, 2 for a node.
void read_offset_flags(const NastranCard& card, NastranLineDetails& line) {
  const std::string flags = card.word(7);
  if (flags.empty() || flags == "1" || flags == "2") return;
  const auto is_one_of = [&](std::size_t i, std::string_view letters) {
    return letters.find(flags[i]) != std::string_view::npos;
  };
  if (flags.size() != 3 || !is_one_of(0, "GB") || !is_one_of(1, "GO") || !is_one_of(2, "GO")) {
    card.fail(7, fmt::format("{} is not supported; OFFT has G or B, and twice G or O",
                             quoted_excerpt(flags)));
  }
  line.basic_orientation = flags[0] == 'B';
  line.own_offsets = {flags[1] == 'O', flags[2] == 'O'};
}

/// X1 to X3 or G0, also of BAROR and BEAMOR.
void read_orientation(const NastranCard& card, NastranLineDetails& line) {
  // An integer in the first field of the vector is the node G0.
  const bool is_node = card.text(7) == "2" || (card.is_integer(4) && card.blank(5) &&
                                               card.blank(6) && card.text(7) != "1");
  if (!card.blank(4) && is_node) {
    line.orientation_node = card.id(4);
    line.has_orientation = true;
  } else {
    for (int i = 0; i < 3; ++i) line.orientation[static_cast<std::size_t>(i)] = card.real(4 + i, 0);
    line.has_orientation = line.orientation != std::array<double, 3>{0, 0, 0};
  }
  read_offset_flags(card, line);
}

void read_beam(const NastranCard& card, NastranBulk& bulk, NastranElement& element) {
  add_nodes(card, 2, 2, 2, bulk, element);
  NastranLineDetails line;
  read_orientation(card, line);
  read_pins(card, line);
  for (std::size_t i = 0; i < 3; ++i) {
    line.offset_a[i] = card.real(10 + static_cast<int>(i), 0.0);
    line.offset_b[i] = card.real(13 + static_cast<int>(i), 0.0);
  }
  element.details = static_cast<std::int32_t>(bulk.lines.size());
  bulk.lines.push_back(line);
}

}  // namespace

void read_nastran_line_defaults(const NastranCard& card, NastranBulk& bulk) {
  NastranLineDefaults& defaults = card.name == "BAROR" ? bulk.bar_defaults : bulk.beam_defaults;
  defaults.property = card.id(1, 0);
  read_orientation(card, defaults.line);
}

bool read_element_card(const NastranCard& card, NastranBulk& bulk, NastranNotes& notes) {
  auto kind = kind_named(card.name);
  const OldElement* const old = old_element(card.name);
  if (old != nullptr) {
    kind = old->kind;
    notes.add(fmt::format("{}: taken as {}{}", card.name, name_of(old->kind), old->difference),
              {card.file, card.line});
  }
  if (!kind) return false;
  NastranElement element;
  element.id = card.id(0);
  element.kind = *kind;
  element.place = {card.file, card.line};
  if (old != nullptr) element.property_card = old->property;
  switch (*kind) {
    case Kind::tetra:
    case Kind::pyramid:
    case Kind::penta:
    case Kind::hexa:
      element.property = card.id(1, element.id);
      read_solid(card, bulk, element);
      break;
    case Kind::tria3:
    case Kind::triar:
    case Kind::quad4:
    case Kind::quadr:
    case Kind::tria6:
    case Kind::quad8:
      element.property = card.id(1, element.id);
      read_shell(card, bulk, element, notes);
      break;
    case Kind::bar:
    case Kind::beam:
      element.property = card.id(1, 0);  // 0: that of BAROR or BEAMOR, or its own number
      read_beam(card, bulk, element);
      break;
    case Kind::rod:
    case Kind::tube:
      element.property = card.id(1, element.id);
      add_nodes(card, 2, 2, 2, bulk, element);
      break;
    case Kind::conrod:
      // Its constants stand on it: the card is its own property.
      element.property = element.id;
      add_nodes(card, 1, 2, 2, bulk, element);
      bulk.cards[card.name].push_back(card);
      break;
  }
  bulk.elements.push_back(element);
  const bool is_rod = *kind == Kind::rod || *kind == Kind::tube;
  if (is_rod && !card.blank(4)) read_element_card(card.second_half(), bulk, notes);
  return true;
}

}  // namespace buckens::mesh_io
