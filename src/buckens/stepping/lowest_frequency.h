// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// Lowest elastic frequency ω₁ of a free body [rad/s], for reports.
///
/// Minimises the Rayleigh quotient of K and M: first over polynomials of the position up to degree
/// 3, along slender bodies up to degree 7, then along preconditioned conjugate directions (locally
/// optimal, Knyazev 2001) with the factor of K̂ that the step has anyway. The shorter the step, the
/// less K̂ distinguishes slow shapes and the more solves it takes, about the steps of a quarter
/// period of ω₁. Stops when the residual bounds the error of ω₁ by about 0.5 %, when four solves
/// have lowered ω₁² by less than 0.1 %, or after 100 solves; never too low.
///
/// @param pool may share the work; changes no bit
double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op,
                        TaskPool* pool = nullptr);

}  // namespace buckens::stepping
