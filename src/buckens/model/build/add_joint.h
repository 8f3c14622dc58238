// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Adds a joint of the model file to the model under construction; a bushing becomes a load.
/// @throws InputError, ModelError naming the joint and its place in the file
void add_joint(const joints::JointSpec& spec, MarkerFinder& find);

}  // namespace buckens::model
