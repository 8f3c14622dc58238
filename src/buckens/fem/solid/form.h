// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace buckens::fem {

/// Shapes of solid elements, named by their nodes. Corners come first, then the mid-side nodes, as
/// in Abaqus (C3D8, C3D20, C3D4, C3D10, C3D6, C3D15, C3D5).
enum class SolidKind {
  hex8,      ///< trilinear hexahedron
  hex20,     ///< quadratic serendipity hexahedron
  tet4,      ///< linear tetrahedron
  tet10,     ///< quadratic tetrahedron
  wedge6,    ///< linear wedge (prism over a triangle)
  wedge15,   ///< quadratic serendipity wedge
  pyramid5,  ///< linear pyramid over a quadrilateral
};

constexpr std::array<const char*, 7> choice_names(SolidKind) {
  return {"hex8", "hex20", "tet4", "tet10", "wedge6", "wedge15", "pyramid5"};
}

/// Integration of the stiffness of a solid element.
enum class SolidIntegration {
  incompatible_modes,  ///< hex8 only: nine inner displacement modes remove shear locking
  full,                ///< the full strain energy of the shape functions
};

constexpr std::array<const char*, 2> choice_names(SolidIntegration) {
  return {"incompatible-modes", "full"};
}

/// A shape and the integration of its stiffness.
struct SolidForm {
  SolidKind kind = SolidKind::hex8;
  SolidIntegration integration = SolidIntegration::incompatible_modes;

  /// Default integration of a shape: incompatible modes for hex8, full for all others.
  static constexpr SolidForm usual(SolidKind kind) {
    return {kind, kind == SolidKind::hex8 ? SolidIntegration::incompatible_modes
                                          : SolidIntegration::full};
  }
  friend bool operator==(const SolidForm&, const SolidForm&) = default;
};

}  // namespace buckens::fem
