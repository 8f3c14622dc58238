// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "buckens/fem/line/section_spec.h"
#include "buckens/mesh_io/nastran/bulk.h"

namespace buckens::mesh_io {

/// Cross-section of a beam or rod from a property card.
///
/// Plane 1 of Nastran holds its y axis: I1 = ∫ y² dA is `Iz` here, I2 is `Iy`. Sections with I12
/// are rotated into their principal axes.
struct NastranSection {
  fem::SectionSpec section;
  std::int64_t material = 0;
  double angle = 0;             ///< of the section's y axis from Nastran's, about x [rad]
  bool shear_flexible = false;  ///< Timoshenko
  double mass_per_length = 0;   ///< NSM, as written
  bool is_bar = false;          ///< there is an area, but no bending and no torsion
  /// Of the neutral axis from the line between the nodes (y, z), in Nastran's axes.
  std::array<double, 2> offset = {0, 0};
  /// Why there is no section if the card can be read but not used; else "".
  std::string lacking;
};

/// Reads PBAR, PBARL, PBEAM, PBEAML; tapered beams get the mean section. Beams of CBEAM are on the
/// neutral axis, to which torsion then also refers.
/// @throws InputError if it cannot be read
NastranSection read_nastran_beam_section(const NastranCard& card, NastranNotes& notes);

/// Reads the area of PROD, PTUBE or CONROD.
NastranSection read_nastran_rod_section(const NastranCard& card, NastranNotes& notes);

}  // namespace buckens::mesh_io
