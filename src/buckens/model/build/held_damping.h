// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"

namespace buckens::model {

/// Makes mass damping act on the motion that the joints leave a body, if requested
/// (fem::FeModel::damps_held_motion): FlexiblePart::C becomes
///
///     C = αM + C_K + α (BᵀWB − BᵀWE Pᵀ − P EᵀWB),   E = BΦ
///
/// r = −B d is the motion of the body frame caused by a deformation d through the joints, with all
/// other bodies rigid: of all motions of the frames that close the joints, the one with the least
/// kinetic energy; W is the inertia of the frame. A vibration of the system in which only this body
/// deforms has that r, so that ḋᵀCḋ = 2αT with T the total kinetic energy of the body, not only
/// that relative to the frame; what the joints do not hold still counts as free. CΦ lies in the
/// span of P. Theory: docs/theory/20-damping.md.
///
/// Joints are taken in the configuration in which the bodies are placed.
/// @pre FlexiblePart::rows and the joints are complete
/// @throws ModelError if the body has several frames, or a joint holds so many nodes that C would
/// be full
void hold_damping(Model& model);

}  // namespace buckens::model
