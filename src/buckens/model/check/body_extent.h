// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body_spec.h"

namespace buckens::model {

/// Largest edge of the bounding box of a body along its model axes, from its spec [m]; slightly
/// more for round solids. 0 for bodies without shape, such as rigid ones.
double body_extent(const body::BodySpec& body);

}  // namespace buckens::model
