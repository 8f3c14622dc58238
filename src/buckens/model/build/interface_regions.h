// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/body/body_spec.h"
#include "buckens/model/build/structure_from_spec.h"
#include "buckens/model/interface_region.h"

namespace buckens::model {

/// Finds the nodes of the interfaces of a body.
/// @throws InputError with the place in the file if the body has no solids, a face or node
/// does not exist, a selection contains no node (saying how near the nearest one is), the
/// frame is away from nodes that define no rotation, or the nodes of a rigid interface are
/// collinear
std::vector<InterfaceRegion> find_interfaces(const body::BodySpec& spec,
                                             const NamedStructure& mesh);

/// Why an interface cannot carry a moment, with the remedy.
std::string why_no_moment(const InterfaceRegion& interface);

}  // namespace buckens::model
