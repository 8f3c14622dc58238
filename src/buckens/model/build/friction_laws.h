// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/joint_friction.h"
#include "buckens/loads/joint_law_spec.h"

namespace buckens::model {

/// What friction in a joint may take from time and signals.
inline loads::FrictionLaws friction_laws(const loads::JointFrictionBase& spec) {
  return {spec.coefficient, spec.dynamic.value_or(spec.coefficient), spec.viscous, spec.preload};
}

}  // namespace buckens::model
