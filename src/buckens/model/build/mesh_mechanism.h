// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"

namespace buckens::model {

/// Refuses meshes with strain-free motions other than rigid ones, such as bars pinned in a row or
/// solids that only share an edge.
///
/// Examines the lowest free vibration: a mechanism appears as one without stiffness. Beams alone,
/// and solids alone connected through faces, are never mechanisms and return at once.
/// @throws ModelError naming the body and the node that moves most
void refuse_mechanisms(const body::Body& body);

}  // namespace buckens::model
