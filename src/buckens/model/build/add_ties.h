// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/marker_finder.h"
#include "buckens/model/build/mesh_division.h"
#include "buckens/model/whole_body.h"

namespace buckens::model {

/// Ties the parts of a divided body: at every node that several parts have, a spanning tree of
/// joints over its copies. Copies with rotations are welded in a row, copies without are pinned to
/// the first; where a node only divides a bar the direction is held, too.
///
/// Comes before the joints of the model file, so that those count as the redundant ones.
void add_ties(const WholeBody& whole, const MeshDivision& division, MarkerFinder& find);

}  // namespace buckens::model
