// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"

namespace buckens::model {

/// Decides about rotations of frames that have no rotary inertia of their own: those of point
/// masses, and of thin bars about their axis.
///
/// A joint off the mass centre gives such a rotation the inertia of the masses that it moves: m l²
/// for a point mass on a joint at the distance l. The coordinate is kept then, without inertia, and
/// the joint determines it; Body::stand_in keeps the matrices of iterations regular. A rotation
/// that nothing turns is dropped and named in `notes`.
/// @param duration of the run, over which laws of loads are looked at [s]
/// @throws ModelError naming joint or load, body and axis, where something turns a rotation that
///         can be neither kept nor dropped: a load, a joint of a flexible body, several bodies that
///         turn together
void settle_massless_rotations(Model& model, double duration);

}  // namespace buckens::model
