// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"

namespace buckens::model {

/// Decides on rotations of frames without rotary inertia of their own: those of point masses, and
/// of thin bars about their axis.
///
/// A joint away from the mass centre gives such a rotation the inertia of the masses that it moves:
/// m l² for a point mass at distance l from the joint. The coordinate is then kept, without
/// inertia, and the joint determines it; Body::stand_in keeps the matrices of iterations regular. A
/// rotation that nothing drives is dropped and named in `notes`.
/// @param duration of the run, over which laws of loads are examined [s]
/// @throws ModelError naming joint or load, body and axis, if something drives a rotation that can
/// be neither kept nor dropped: a load, a joint of a flexible body, several bodies that rotate
/// together
void settle_massless_rotations(Model& model, double duration);

}  // namespace buckens::model
