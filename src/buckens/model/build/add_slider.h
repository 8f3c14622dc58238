// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/joint_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Adds a slider on a beam, with a marker on every node of its way.
/// @throws InputError or ModelError naming the joint, if the first body has no such beams
void add_slider(const joints::JointSpec& spec, MarkerFinder& find);

}  // namespace buckens::model
