// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// Lowest elastic frequency ω₁ of a free body [rad/s], for reports.
///
/// Minimises the Rayleigh quotient of K and M: first among polynomials of the place up to degree 3,
/// then along preconditioned conjugate directions (locally optimal, Knyazev 2001) with the factor
/// of K̂ that the step has anyway. The shorter the step, the less K̂ tells slow shapes apart and the
/// more solves it takes, about as many as a quarter of a period of ω₁ has steps. Ends when the
/// residual bounds the error of ω₁ by about 0.5 %, at the latest after 100 solves; never too low.
double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op);

}  // namespace buckens::stepping
