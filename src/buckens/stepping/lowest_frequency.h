// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// Lowest elastic frequency ω₁ of a free body [rad/s], for reports.
///
/// Lanczos steps on Y K̂⁻¹M in the M-product with the factor that the step has anyway: no
/// factorisation, one large solve per Lanczos step, 24 at most. Ends when ω₁ changes by less than a
/// tenth of a percent; a Ritz value is never too low.
double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op);

}  // namespace buckens::stepping
