// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/line/section_spec.h"

namespace buckens::mesh_io {

/// A rectangular hollow section given by its outer dimensions, with equal opposite walls.
struct BoxWalls {
  double width = 0;   ///< along local y
  double height = 0;  ///< along local z
  double side = 0;    ///< thickness of the two walls along z
  double flat = 0;    ///< thickness of the two walls along y
};

/// A box of one wall thickness, or the constants of one with two: torsion by Bredt's formula; a
/// shear force is carried by the walls parallel to it.
/// @param box whose walls leave it hollow
fem::SectionSpec box_section(const BoxWalls& box);

}  // namespace buckens::mesh_io
