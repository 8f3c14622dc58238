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
  static const Names names = {"CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S", "PSOLID",
                              "PSHELL", "PCOMP",  "PCOMPG", "PBAR",   "PBARL",  "PBEAM",  "PBEAML",
                              "PROD",   "PBUSH",  "MAT1",   "MAT2",   "MAT3",   "MAT8",   "MAT9",
                              "MAT10",  "CONM2",  "CBUSH",  "RBE2",   "RBE3",   "RBAR",   "MPC",
                              "MPCADD", "SET1",   "SET3"};
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

/// Cards without which the structure would be another one.
const char* reason_to_refuse(std::string_view name) {
  static const std::map<std::string_view, const char*> reasons = {
      {"SPOINT", "scalar points are not supported; take them and what uses them out"},
      {"EPOINT", "extra points are not supported; take them and what uses them out"},
      {"CQUAD8", "shells with mid-side nodes are not supported; mesh with CQUAD4"},
      {"CTRIA6", "shells with mid-side nodes are not supported; mesh with CTRIA3"},
      {"CQUAD", "hyperelastic shells are not supported; mesh with CQUAD4"},
      {"CSHEAR", "shear panels are not supported; use CQUAD4"},
      {"CTUBE", "tubes are not supported; use CROD with the area of the tube"},
      {"CBEND", "curved beams are not supported; use a chain of CBEAM"},
      {"CBEAM3", "three-node beams are not supported; use two CBEAM"},
      {"CONM1", "full mass matrices are not supported; use CONM2"},
      {"CMASS1", "scalar masses are not supported; use CONM2"},
      {"CMASS2", "scalar masses are not supported; use CONM2"},
      {"CELAS1", "scalar springs are not supported; use CBUSH"},
      {"CELAS2", "scalar springs are not supported; use CBUSH"},
      {"CELAS3", "scalar springs are not supported; use CBUSH"},
      {"CELAS4", "scalar springs are not supported; use CBUSH"},
      {"CWELD", "connections of patches are not supported; use RBE3 and CBUSH"},
      {"CFAST", "connections of patches are not supported; use RBE3 and CBUSH"},
      {"CSEAM", "connections of patches are not supported; use RBE3"},
      {"CTRIAX6", "axisymmetric elements have no place in a spatial body"},
      {"CTRIAX", "axisymmetric elements have no place in a spatial body"},
      {"CQUADX", "axisymmetric elements have no place in a spatial body"},
      {"RBE1", "this rigid element is not supported; use RBE2"},
      {"RROD", "this rigid element is not supported; use RBAR or MPC"},
      {"RTRPLT", "this rigid element is not supported; use RBE2"},
      {"RTRPLT1", "this rigid element is not supported; use RBE2"},
      {"RBAR1", "this rigid element is not supported; use RBAR"},
      {"RJOINT", "this rigid element is not supported; use a joint of the model file"},
      {"RSPLINE", "this interpolation is not supported; use RBE3"},
      {"RSSCON", "this connection is not supported; use RBE3"},
      {"BAROR", "defaults of CBAR are not supported; write them on the elements"},
      {"BEAMOR", "defaults of CBEAM are not supported; write them on the elements"},
      {"GENEL", "general elements are not supported"},
      {"BEGIN", "further bulk data sections (superelements) are not supported"}};
  const auto entry = reasons.find(name);
  return entry == reasons.end() ? nullptr : entry->second;
}

NastranGrid read_grid(const NastranCard& card, NastranNotes& notes) {
  NastranGrid grid;
  grid.id = card.id(0);
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
    if (card.integer(field, 0) < 0) card.fail(field, "this is not a coordinate system");
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

NastranBulk read_nastran_bulk(NastranCardReader& reader, NastranNotes& notes) {
  // A gigabyte of fields that are kept.
  constexpr std::size_t kMostFields = std::size_t{1} << 26;
  NastranBulk bulk;
  NastranCard card;
  std::size_t num_kept_fields = 0;
  while (reader.next(card)) {
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
    } else if (card.name == "PARAM") {
      read_parameter(card, bulk, notes);
    } else if (const char* reason = reason_to_refuse(card.name)) {
      card.fail(reason);
    } else {
      note_unused(card, notes);
    }
  }
  return bulk;
}

}  // namespace buckens::mesh_io
