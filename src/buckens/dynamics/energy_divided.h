// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/body/body.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// What the deformation of a body is for its energies.
struct DeformationEnergy {
  double kinetic = 0;  ///< ½ ḋᵀM ḋ [J]
  double strain = 0;   ///< ½ dᵀK d [J]
  /// J and l of the kinetic energy of the terms in use.
  body::DeformedMoments moments;
};

/// Which moments that kinetic energy has: none, J₁, or all of J and l.
enum class KineticTerms { none, first_order, all };
KineticTerms kinetic_terms(const body::CouplingTerms& terms);

/// Of a body of which other processes have d and ḋ: one program, from which sums come.
DeformationEnergy deformation_energy(const body::Body& body, const model::BodyState& state,
                                     const std::shared_ptr<linalg::DividedVectors>& of);

}  // namespace buckens::dynamics
