// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "buckens/loads/contact_friction.h"
#include "buckens/model/contact_group.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// A row of a rigid contact: a load, and the coordinate that it acts on.
struct RigidContactRow {
  Load load;  ///< without the number of its coordinate
  Coordinate coordinate;
};

/// The rows of a rigid contact: in each place where it can touch a stop, followed by friction along
/// each direction of the surface.
/// @param like name, kind and markers of all loads, @param size of the smaller shape [m]
std::vector<RigidContactRow> rigid_contact_rows(const Load& like,
                                                const std::vector<spatial::RigidTouch>& touches,
                                                const RigidPairLaw& law, double size);

/// The least distance in the places where a pair can touch [m].
/// @param placed both markers
double least_gap(const std::vector<spatial::RigidTouch>& touches, const joints::Placement& placed);

/// What a model says about a rigid contact.
RigidPairLaw rigid_pair_law(const loads::ContactForceSpec& spec);

}  // namespace buckens::model
