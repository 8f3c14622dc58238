// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/analysis/vibration/vibration.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Elastic vibrations of one free flexible body, FM §4, with generalised masses and
/// the shares of its element groups in the strain energy. Free modes have no effective masses:
/// PᵀΨ = 0. Theory: docs/theory/04-free-vibration.md.
/// @param whole index into model::Model::wholes of a flexible body; for a divided one the whole
/// mesh vibrates
/// @throws ModelError, NumericalError as body::free_free_modes()
VibrationReport free_body_vibrations(const model::BuiltModel& built, int whole,
                                     const body::FreeModesSettings& settings);

/// Largest displacement of a node or, if negligible, largest rotation times `size`
/// [m].
double largest_motion(const fem::FeModel& fe, const linalg::Vector& d, double size);

}  // namespace buckens::analysis
