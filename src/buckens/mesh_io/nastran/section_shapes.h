// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace buckens::mesh_io {

/// Constants of a cross-section in the axes of Nastran, y up and z to the right in its figures.
struct NastranShapeConstants {
  double A = 0;
  double I1 = 0, I2 = 0, I12 = 0;  ///< ∫y², ∫z², ∫yz about the centroid
  double J = 0;
  double K1 = 0, K2 = 0;  ///< fractions of the area that carry shear along y and z
  /// Centroid from the shear centre.
  double y = 0, z = 0;
  std::vector<std::array<double, 2>> corners;  ///< outermost points from the centroid (y, z)
};

/// Number of dimensions of a shape of PBARL and PBEAML that is made of plates or is a hexagon:
/// I, I1, T, T1, T2, L, CHAN, CHAN1, CHAN2, CROSS, H, Z, HAT, BOX1, HEXA. @return 0: none of
/// them
int num_nastran_shape_dimensions(std::string_view type);

/// Area and second moments are exact for plates with sharp corners. Torsion: of open sections
/// ⅓ Σ l t³ along the middle lines, of closed ones Bredt's formula, of the hexagon Saint-Venant's
/// A⁴/(40 Ip). Shear: the plates along the force. Shear centre: T, L: where middle lines meet; I
/// and CHAN: thin-wall formula; others: at the centroid.
/// @return area 0 if the plates do not fit together
NastranShapeConstants nastran_shape(std::string_view type, const std::vector<double>& dimensions);

}  // namespace buckens::mesh_io
