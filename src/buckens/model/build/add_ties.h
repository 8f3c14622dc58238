// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/marker_finder.h"
#include "buckens/model/build/mesh_division.h"
#include "buckens/model/whole_body.h"

namespace buckens::model {

/// Ties the parts of a divided body: at every node shared by several parts, a spanning tree of
/// joints over its copies. Copies with rotations are welded in a chain, copies without are pinned
/// to the first; where a node only divides a bar, the direction is held as well.
///
/// Must come before the joints of the model file, so that those count as the redundant ones.
void add_ties(const WholeBody& whole, const MeshDivision& division, MarkerFinder& find);

}  // namespace buckens::model
