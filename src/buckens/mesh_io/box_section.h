// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

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

/// A rectangular hollow section whose four walls differ, seen from the centre of its outline.
struct UnequalBox {
  fem::SectionSpec section;          ///< in its principal axes through the centroid
  std::array<double, 2> centroid{};  ///< from the centre of the outline (y, z)
  double angle = 0;                  ///< from y to the first principal axis, about x [rad]
};

/// Area, centroid and second moments are exact. Torsion: Bredt's formula and ⅓ Σ l t³, so that a
/// box with a very thin wall has the stiffness of a channel. A shear force is carried by the walls
/// parallel to it.
/// @param width along local y, @param height along local z
/// @param walls on the sides of +y, +z, −y and −z; they leave it hollow
UnequalBox unequal_box_section(double width, double height, const std::array<double, 4>& walls);

}  // namespace buckens::mesh_io
