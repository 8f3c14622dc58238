// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/shell/strain.h"

namespace buckens::fem {

/// Where strains are wanted in addition to the integration points.
enum class ShellStrainPlaces { none, centre, nodes };

/// Strains of shells with nodes on their sides.
///
/// Inner variables turn a quadrilateral with eight nodes into one with nine: the displacement of
/// its centre and the rotation of its director, with (1 − r²)(1 − s²). Its transverse shear is
/// that of MITC9 (Bucalem, Bathe, 1993). The triangle with six nodes rotates its director by a
/// cubic bubble; its transverse shear is that of MITC7 (Brezzi, Bathe, Fortin, 1989). Membrane
/// strains are ε = q ε_u + (1 − q) ε_t with ε_u from the displacements, ε_t tied as in MITC9 and
/// MITC6 (Lee, Bathe, 2004), and q = 1/(1 + (100 |n_i − n| l/h)²) with the normals n_i of the
/// nodes: flat elements of any shape stretch uniformly without error, thin curved ones bend without
/// stretching.
///
/// Strains at the centre and the nodes are those of 2×2 points (three of the triangle),
/// extrapolated.
ShellStrainField quadratic_strain(const ShellElement& element, ShellStrainPlaces places);

}  // namespace buckens::fem
