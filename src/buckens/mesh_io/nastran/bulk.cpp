// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/bulk.h"

#include <set>
#include <string_view>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/element_cards.h"

namespace buckens::mesh_io {

namespace {

using Names = std::set<std::string_view>;

const Names& kept_names() {
  static const Names names = {
      "CORD1R", "CORD1C", "CORD1S",  "CORD2R",  "CORD2C",  "CORD2S", "PSOLID", "PSHELL", "PCOMP",
      "PCOMPG", "PBAR",   "PBARL",   "PBEAM",   "PBEAML",  "PROD",   "PTUBE",  "PBUSH",  "PIHEX",
      "PQUAD1", "PQUAD2", "PQDMEM",  "PQDMEM1", "PQDMEM2", "PTRIA1", "PTRIA2", "PTRMEM", "MAT1",
      "MAT2",   "MAT3",   "MAT8",    "MAT9",    "MAT10",   "CONM1",  "SPOINT", "CELAS1", "CELAS2",
      "CELAS3", "CELAS4", "PELAS",   "CMASS1",  "CMASS2",  "CMASS3", "CMASS4", "PMASS",  "CONM2",
      "CBUSH",  "RBE2",   "RBE3",    "RBAR",    "RBE1",    "RTRPLT", "RROD",   "CRIGD1", "CRIGD2",
      "CRIGD3", "CRIGDR", "MPC",     "MPCADD",  "SET1",    "SET3",   "NSM",    "NSM1",   "NSML",
      "NSML1",  "NSMADD", "CBUSH1D", "PBUSH1D"};
  return names;
}

const Names& support_names() {
  static const Names names = {"SPC",    "SPC1",   "SPCADD", "SPCD",   "SUPORT",  "SUPORT1",
                              "FORCE",  "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2",
                              "PLOAD",  "PLOAD1", "PLOAD2", "PLOAD4", "GRAV",    "LOAD",
                              "RFORCE", "TEMP",   "TEMPD",  "ACCEL",  "ACCEL1",  "DAREA",
                              "DLOAD",  "RLOAD1", "RLOAD2", "TLOAD1", "TLOAD2"};
  return names;
}

/// Cards named like elements that have neither mass nor stiffness for us: heat, fluids, air,
/// contact, damping, pressure that follows a surface (CPSE2 … 4), and what numbers or names
/// something.
const Names& harmless_names() {
  static const Names names = {
      "CHBDY",   "CHBDYE",  "CHBDYG",  "CHBDYP",  "CONV",    "CONVM",   "CAERO1",  "CAERO2",
      "CAERO3",  "CAERO4",  "CAERO5",  "CAERO7",  "CSSCHD",  "CELLBOX", "CELLWNG", "CAABSF",
      "CACINF3", "CACINF4", "CHACAB",  "CHACBR",  "CFLUID2", "CFLUID3", "CFLUID4", "CAXIF2",
      "CAXIF3",  "CAXIF4",  "CSLOT3",  "CSLOT4",  "CFFREE",  "CFHEX1",  "CFHEX2",  "CFLSTR",
      "CFTETRA", "CFWEDGE", "CDAMP1",  "CDAMP2",  "CDAMP3",  "CDAMP4",  "CDAMP5",  "CVISC",
      "CGAP",    "CBARAO",  "CGEN",    "CLOAD",   "CMFREE",  "CNGRNT",  "CREEP",   "CYAX",
      "CYJOIN",  "CYSUP",   "CYSYM",   "CSET",    "CSET1",   "CSUPER",  "CSUPEXT", "CEMLOOP",
      "CRAKTP",  "CONTRLT", "CONCHEM", "CONSTIT", "CAMPBEL", "CASECC",  "CBUTT",   "CELUSET",
      "CIFQUAD", "CIFHEX",  "COMBWLD", "CORD3G",  "CSPOT",   "CONEAX0", "CNTRLT",  "CPSE2",
      "CPSE3",   "CPSE4"};
  return names;
}

/// Whether a name is that of an element that the structure would be missing.
bool is_unknown_element(std::string_view name) {
  const bool is_rigid = name.starts_with("RBE") || name.starts_with("CRBE") ||
                        name.starts_with("CRIG") || name == "CRBAR" || name == "CRROD" ||
                        name == "CRTRPLT" || name == "CRSPLINE";
  return is_rigid || (name.starts_with('C') && !harmless_names().contains(name));
}

/// Cards without which the structure would be different.
std::string reason_to_refuse(std::string_view name) {
  static const std::map<std::string_view, const char*> reasons = {
      {"CQUAD", "hyperelastic shells are not supported; mesh with CQUAD4"},
      {"CSHEAR", "shear panels are not supported; use CQUAD4"},
      {"CBEND", "curved beams are not supported; use a chain of CBEAM"},
      {"CBEAM3", "three-node beams are not supported; use two CBEAM"},
      {"CWELD", "connections of patches are not supported; use RBE3 and CBUSH"},
      {"CFAST", "connections of patches are not supported; use RBE3 and CBUSH"},
      {"CSEAM", "connections of patches are not supported; use RBE3"},
      {"CTRIAX6", "axisymmetric elements cannot be part of a three-dimensional body"},
      {"CTRIAX", "axisymmetric elements cannot be part of a three-dimensional body"},
      {"CQUADX", "axisymmetric elements cannot be part of a three-dimensional body"},
      {"RTRPLT1", "this rigid element is not supported; use RBE2"},
      {"RBAR1", "this rigid element is not supported; use RBAR"},
      {"RJOINT", "this rigid element is not supported; use a joint of the model file"},
      {"RSPLINE", "this interpolation is not supported; use RBE3"},
      {"RSSCON", "this connection is not supported; use RBE3"},
      {"GENEL", "general elements are not supported"}};
  const auto entry = reasons.find(name);
  if (entry != reasons.end()) return entry->second;
  return is_unknown_element(name) ? "this element is not supported" : "";
}

[[noreturn]] void refuse_further_section(const NastranCard& card) {
  throw InputError(card.where(),
                   "a further section of bulk data (BEGIN SUPER, a superelement) is not supported; "
                   "write it as a separate deck, or have Nastran write a single section" +
                       SkipList::remedy("SUPER"));
}

NastranGrid read_grid(const NastranCard& card, NastranNotes& notes) {
  NastranGrid grid;
  grid.id = card.id(0);
  constexpr int kMostFields = 8;
  if (card.size() > kMostFields) card.fail(kMostFields, "a GRID has eight fields at most");
  grid.cp = card.integer(1, NastranGrid::kBlank);
  for (int i = 0; i < 3; ++i) grid.x[static_cast<std::size_t>(i)] = card.real(2 + i, 0.0);
  grid.cd = card.integer(5, NastranGrid::kBlank);
  for (const int field : {1, 5}) {
    if (!card.blank(field) && card.integer(field) < 0) {
      card.fail(field, fmt::format("{} is not a coordinate system; fluid points are not supported",
                                   card.integer(field)));
    }
  }
  grid.place = {card.file, card.line};
  if (!card.blank(6) && card.text(6) != "0") {
    notes.add("GRID: supports in field 8 (PS) are ignored; bodies are held by joints of the model",
              grid.place);
  }
  return grid;
}

void read_grid_defaults(const NastranCard& card, NastranBulk& bulk) {
  bulk.default_cp = card.integer(1, 0);
  bulk.default_cd = card.integer(5, 0);
  for (const int field : {1, 5}) {
    if (card.integer(field, 0) >= 0) continue;
    card.fail(field, fmt::format("{} is not a coordinate system; fluid points are not supported",
                                 card.integer(field)));
  }
}

void note_unused(const NastranCard& card, NastranNotes& notes) {
  const NastranPlace place{card.file, card.line};
  if (support_names().contains(card.name)) {
    notes.add(fmt::format("{}: ignored; supports and loads belong in the model file", card.name),
              place, true);
  } else {
    notes.add(fmt::format("{}: ignored; it is not part of a mesh that can be imported", card.name),
              place);
  }
}

void read_parameter(const NastranCard& card, NastranBulk& bulk, NastranNotes& notes) {
  if (card.word(0) == "WTMASS") {
    bulk.weight_to_mass = card.positive(1);
    return;
  }
  notes.add("PARAM other than WTMASS: left out", {card.file, card.line});
}

}  // namespace

const std::vector<NastranCard>& NastranBulk::cards_named(const std::string& name) const {
  static const std::vector<NastranCard> none;
  const auto entry = cards.find(name);
  return entry == cards.end() ? none : entry->second;
}

NastranBulk read_nastran_bulk(NastranCardReader& reader, SkipList& skip, NastranNotes& notes) {
  // A gigabyte of fields that are kept.
  constexpr std::size_t kMostFields = std::size_t{1} << 26;
  NastranBulk bulk;
  NastranCard card;
  std::size_t num_kept_fields = 0;
  bool is_left_out = false;  // a further section of bulk data
  while (reader.next(card)) {
    if (card.name == "BEGIN") {
      if (!skip.takes("SUPER", card.line)) refuse_further_section(card);
      is_left_out = true;
    }
    if (is_left_out || skip.takes(card.name, card.line)) continue;
    if (card.name == "GRID") {
      bulk.grids.push_back(read_grid(card, notes));
    } else if (read_element_card(card, bulk, notes)) {
      continue;
    } else if (kept_names().contains(card.name)) {
      num_kept_fields += card.fields.size();
      if (num_kept_fields > kMostFields) card.fail("the deck is too large");
      bulk.cards[card.name].push_back(card);
    } else if (card.name == "GRDSET") {
      read_grid_defaults(card, bulk);
    } else if (card.name == "BAROR" || card.name == "BEAMOR") {
      read_nastran_line_defaults(card, bulk);
    } else if (card.name == "PARAM") {
      read_parameter(card, bulk, notes);
    } else if (const std::string reason = reason_to_refuse(card.name); !reason.empty()) {
      card.fail(reason + SkipList::remedy(card.name));
    } else {
      note_unused(card, notes);
    }
  }
  for (NastranElement& element : bulk.elements) {
    if (element.property != 0) continue;
    const bool is_bar = element.kind == NastranElementKind::bar;
    const std::int64_t general = is_bar ? bulk.bar_defaults.property : bulk.beam_defaults.property;
    element.property = general != 0 ? general : element.id;
  }
  return bulk;
}

}  // namespace buckens::mesh_io
