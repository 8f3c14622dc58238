// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"

namespace buckens::model {

/// Makes mass damping act on the motion that the joints leave a body, where that is asked for
/// (fem::FeModel::damps_held_motion): FlexiblePart::C becomes
///
///     C = αM + C_K + α (BᵀWB − BᵀWE Pᵀ − P EᵀWB),   E = BΦ
///
/// r = −B d is the motion of the body frame by which the joints answer a deformation d, all other
/// bodies taken as rigid: of all motions of the frames that close the joints the one of least
/// kinetic energy, W the inertia of the frame. A vibration of the system in which this body alone
/// deforms has that r, so that ḋᵀCḋ = 2αT with T all kinetic energy of the body, not that relative
/// to the frame alone; what joints do not hold still counts as free. CΦ lies in the span of P.
/// Theory: docs/theory/20-damping.md.
///
/// Joints count as they stand where the bodies are placed.
/// @pre FlexiblePart::rows and the joints are complete
/// @throws ModelError where the body has several frames, or a joint holds so many nodes that C
///   would be full
void hold_damping(Model& model);

}  // namespace buckens::model
