// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// What a body's level of coupling leaves out of FM (19), (21)–(24) at a state, relative to
/// everything that acts:
///
///     (‖Yᵀf‖ + |τ|/√J) / (‖M d̈‖ + ‖K d + C ḋ‖ + ‖F‖ + √J (|ẇ| + |w|²))
///
/// with f, τ the neglected nodal loads and frame torque, ‖·‖ = √(Σ fᵢ²/K̂ᵢᵢ), J = ‖J₀‖, and F the
/// loads of joints and force elements. √J is approximately that norm of the inertia loads of a
/// rotation while h ω is small. The norm of K̂⁻¹ itself would take a large solve for each of the
/// four loads. Cost: nine sparse products and one with M.
/// @param kept terms in use
/// @param interface_load F along the interface rows, if it is known that the state satisfies the
///        equations of motion with it: then K d + C ḋ follows from the balance. Without it they are
///        multiplied out, and F follows.
double neglected_share(const body::Body& body, const BodyStepOperator& op,
                       const model::BodyState& state, const body::CouplingTerms& kept,
                       const linalg::Vector* interface_load = nullptr);

}  // namespace buckens::stepping
