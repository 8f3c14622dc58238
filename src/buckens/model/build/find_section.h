// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/build_model.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Finds the elements whose section forces or stresses a sensor reads: the first beam or bar that
/// touches the marker, the solids around it where there is none, or the numbered element.
/// @param of_forces true for section forces, which solids do not have
/// @throws InputError, ModelError with the place in the file
void find_section(const SectionPlace& kind, bool of_forces, MarkerFinder& find, SensorPlace& found);

}  // namespace buckens::model
