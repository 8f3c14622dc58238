// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Adds the signals that drives follow behind those of the model file: the position itself, or
/// integrals of speed and acceleration that begin at zero.
void add_drives(const ModelDescription& description, Model& model);

/// Steers the rows of these drives from where their signals begin.
/// @pre signals are connected
/// @throws ModelError naming joint and signal where the drive cannot follow: positions need signals
///         whose rate does not jump and follows from the positions of bodies alone, and so on for
///         speeds; docs/theory/24-control.md
void settle_drives(const ModelDescription& description, Model& model);

}  // namespace buckens::model
