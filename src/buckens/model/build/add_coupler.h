// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Whether a joint couples or drives coordinates of others, which have to be there before it.
bool is_coupler(const joints::JointSpec& spec);

/// Adds a coupler behind the joints that it couples.
/// @throws ModelError if a marker of theirs carries no moment where one is needed
void add_coupler(const joints::JointSpec& spec, MarkerFinder& find);

/// Adds a drive of a coordinate behind the joint that it drives.
/// @throws ModelError if a marker of that carries no moment where one is needed
void add_coordinate_drive(const joints::JointSpec& spec, MarkerFinder& find);

}  // namespace buckens::model
