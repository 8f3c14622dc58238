// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/body/body_spec.h"
#include "buckens/fem/fe_model.h"

namespace buckens::analysis {

/// Fraction η² of the strain energy that a mesh of solids lacks in a deformation, from the
/// difference between strains of its elements and continuous ones; docs/theory/21-errors.md (E2).
/// @param displacements one row per node, translations in the first three columns [m]
/// @return empty without solids or without deformation
std::optional<double> recovered_error(const fem::FeModel& mesh,
                                      const linalg::Matrix& displacements);

/// Makes the materials of a mesh from a file softer or stiffer.
/// @param factor of all moduli
/// @return false if the body is not such a mesh
bool scale_moduli(body::BodySpec& spec, double factor);

}  // namespace buckens::analysis
