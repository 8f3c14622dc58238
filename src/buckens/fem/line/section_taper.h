// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>

#include "buckens/fem/line/section.h"

namespace buckens::fem {

/// Section along a beam: s from 0 at its first end to 1 at its second.
using SectionLaw = std::function<Section(double)>;

/// Polynomial of degree four in ξ ∈ [0, 1], lowest power first.
using Quartic = std::array<double, 5>;

inline Quartic constant_quartic(double value) { return {value, 0.0, 0.0, 0.0, 0.0}; }
double value_at(const Quartic& p, double xi);
/// ∫ p dξ
double integral(const Quartic& p);

/// The section of one element of a tapered beam.
struct SectionTaper {
  Section first, middle, last;
  /// Through five points; exact where the measures of the section are linear.
  Quartic A, Iy, Iz;
  // Flexibility, by twelve Gauss points: the error is below 1e-10 where one end of an element has a
  // fifth of the size of the other, 1e-6 for a tenth.
  double per_A = 0;                                ///< ∫ dξ/A [1/m²]
  double per_J = 0;                                ///< ∫ dξ/J [1/m⁴]
  double per_shear_y = 0, per_shear_z = 0;         ///< ∫ dξ/(κ A) [1/m²]
  std::array<double, 3> per_Iy = {}, per_Iz = {};  ///< ∫ (1 − ξ)ᵏ dξ/I, k = 0, 1, 2 [1/m⁴]
};

/// @param from, to positions s of the ends of the element
SectionTaper section_taper(const SectionLaw& law, double from, double to);

}  // namespace buckens::fem
