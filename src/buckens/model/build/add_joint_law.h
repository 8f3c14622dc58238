// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/joints/joint_spec.h"
#include "buckens/loads/load_spec.h"
#include "buckens/model/build/marker_finder.h"
#include "buckens/model/spec/event_spec.h"

namespace buckens::model {

/// Whether a load is a law on the coordinate of a joint.
bool is_joint_law(const loads::LoadSpec& spec);

/// Adds a law on the coordinate of a joint to the model under construction.
/// @param length characteristic length of the model [m]
/// @throws ModelError naming the law, if the joint has no such coordinate
void add_joint_law(const loads::LoadSpec& spec, MarkerFinder& find, double length);

/// Adds what holds the coordinates of a joint that events lock, free at the start.
void add_lock(const joints::JointSpec& joint, MarkerFinder& find);

/// Index into Model::coordinates of a coordinate of a joint, added if missing.
/// @param asked `which` of the model file, none: the one that is meant by its sort
/// @return −1 if there is no such joint
/// @throws ModelError if a planar model leaves the joint no such coordinate
int find_coordinate(const std::string& joint, std::optional<base::CoordinateChoice> asked,
                    base::CoordinateSort sort, MarkerFinder& find);

}  // namespace buckens::model
