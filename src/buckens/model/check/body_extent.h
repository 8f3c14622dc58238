// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body_spec.h"

namespace buckens::model {

/// Largest edge of the box around a body along its model axes, as its spec says [m]; of round
/// solids somewhat more. 0 for bodies without shape, such as rigid ones.
double body_extent(const body::BodySpec& body);

}  // namespace buckens::model
