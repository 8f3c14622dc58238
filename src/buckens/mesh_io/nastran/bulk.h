// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "buckens/mesh_io/nastran/card_reader.h"
#include "buckens/mesh_io/nastran/notes.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

/// Elements with their own block.
enum class NastranElementKind {
  tetra,
  pyramid,
  penta,
  hexa,
  tria3,
  triar,
  quad4,
  quadr,
  tria6,
  quad8,
  bar,
  beam,
  rod,
  tube,
  conrod,
};

constexpr const char* name_of(NastranElementKind kind) {
  constexpr std::array<const char*, 15> names = {"CTETRA", "CPYRAM", "CPENTA", "CHEXA",  "CTRIA3",
                                                 "CTRIAR", "CQUAD4", "CQUADR", "CTRIA6", "CQUAD8",
                                                 "CBAR",   "CBEAM",  "CROD",   "CTUBE",  "CONROD"};
  return names[static_cast<std::size_t>(kind)];
}

/// A GRID as written.
struct NastranGrid {
  static constexpr std::int64_t kBlank = -1;
  std::int64_t id = 0;
  std::int64_t cp = kBlank;
  std::int64_t cd = kBlank;
  std::array<double, 3> x = {0, 0, 0};
  NastranPlace place;
};

/// An element as written.
struct NastranElement {
  std::int64_t id = 0;
  std::int64_t property = 0;
  NastranElementKind kind = NastranElementKind::tetra;
  int num_nodes = 0;
  std::uint32_t first_node = 0;  ///< in NastranBulk::element_nodes
  std::int32_t details = -1;     ///< in NastranBulk::shells or lines
  /// Of elements of NASTRAN-95: the card of the property, "MAT1" if it is a material.
  const char* property_card = nullptr;
  NastranPlace place;
};

/// Fields of shells beyond nodes and property, where any is given.
struct NastranShellDetails {
  bool has_system = false;  ///< MCID instead of THETA
  std::int64_t system = 0;  ///< MCID
  double theta = 0;         ///< [degrees]
  double offset = 0;        ///< ZOFFS
  bool relative = false;    ///< TFLAG: thicknesses are fractions of that of the property
  /// T1…, those without a value as the property says; empty if all are blank
  std::vector<std::optional<double>> thickness;
};

/// Fields of CBAR and CBEAM beyond nodes and property.
struct NastranLineDetails {
  bool has_orientation = false;       ///< otherwise that of BAROR or BEAMOR applies
  std::int64_t orientation_node = 0;  ///< G0; 0: the vector counts
  std::array<double, 3> orientation = {0, 0, 0};
  bool basic_orientation = false;  ///< vector in the basic system, not in that of the first node
  std::array<double, 3> offset_a = {0, 0, 0};
  std::array<double, 3> offset_b = {0, 0, 0};
  std::array<bool, 2> own_offsets = {false, false};  ///< in the axes of the beam, not of its node
  std::array<std::array<bool, 6>, 2> pins{};         ///< PA, PB: released in the axes of the beam
};

/// BAROR or BEAMOR: defaults of elements.
struct NastranLineDefaults {
  std::int64_t property = 0;  ///< 0: none
  NastranLineDetails line;
};

/// The bulk data as written: numbers read, references not yet resolved.
struct NastranBulk {
  std::vector<NastranGrid> grids;
  std::int64_t default_cp = 0;  ///< GRDSET
  std::int64_t default_cd = 0;
  std::vector<NastranElement> elements;
  static constexpr std::int64_t kNoNode = 0;  ///< a mid-side node that is left out
  std::vector<std::int64_t> element_nodes;
  std::vector<NastranShellDetails> shells;
  std::vector<NastranLineDetails> lines;
  NastranLineDefaults bar_defaults, beam_defaults;
  /// Cards that are read when referred to, and those of which there are few.
  std::map<std::string, std::vector<NastranCard>> cards;
  double weight_to_mass = 1;  ///< PARAM,WTMASS

  /// The cards of a name; empty if there are none.
  const std::vector<NastranCard>& cards_named(const std::string& name) const;
};

/// Reads all cards except those to leave out. Cards that are not part of a mesh are noted with
/// their number.
/// @throws InputError with the place for what cannot be read, and for cards that change the
/// structure and are not supported
NastranBulk read_nastran_bulk(NastranCardReader& reader, SkipList& skip, NastranNotes& notes);

}  // namespace buckens::mesh_io
