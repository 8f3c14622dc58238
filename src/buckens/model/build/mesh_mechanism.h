// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"

namespace buckens::model {

/// Refuses meshes that move without strain beyond rigid motion, such as bars pinned in a row or
/// solids that share an edge only.
///
/// Looks at the lowest free vibration: a mechanism shows as one of no stiffness. Beams alone, and
/// solids alone that hang together by faces, are none and return at once.
/// @throws ModelError naming the body and the node that moves most
void refuse_mechanisms(const body::Body& body);

}  // namespace buckens::model
