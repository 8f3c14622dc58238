// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// What a body's level of coupling leaves out at a state, relative to all that acts:
///
///     (‖Yᵀf‖ + |τ|/√J) / (‖M d̈‖ + ‖K d‖ + ‖F‖ + √J (|ẇ| + |w|²))
///
/// with f, τ the neglected nodal loads and frame torque, ‖·‖ = √(Σ fᵢ²/K̂ᵢᵢ), J = ‖J₀‖, and F what
/// joints and loads contribute: what M d̈, C ḋ, K d and the kept terms leave to be balanced. √J is
/// that norm of the inertia loads of a turn, near enough while h ω is small.
/// Cost: nine sparse products and those with M and K.
/// @param kept terms in use
double neglected_share(const body::Body& body, const BodyStepOperator& op,
                       const model::BodyState& state, const body::CouplingTerms& kept);

}  // namespace buckens::stepping
