// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/loads/load_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Whether a load is a law on the coordinate of a joint.
bool is_joint_law(const loads::LoadSpec& spec);

/// Adds a law on the coordinate of a joint to the model under construction.
/// @param length characteristic length of the model [m]
/// @throws ModelError naming the law, if the joint has no such coordinate
void add_joint_law(const loads::LoadSpec& spec, MarkerFinder& find, double length);

/// Index into Model::coordinates of the angle or displacement of a joint, added if missing.
/// @return −1 if there is no such joint
int find_coordinate(const std::string& joint, joints::JointCoordinate::Kind kind,
                    MarkerFinder& find);

}  // namespace buckens::model
