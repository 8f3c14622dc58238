// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/iterated_modes.h"
#include "buckens/linalg/factor.h"

namespace buckens::body {

/// Modes of a large body by the processes that share its matrices, linalg/shared_modes.h, with a
/// suitable μ as in iterate_with_shift(). No process has M, K, K + μM or the vectors of the search.
/// @pre linalg::is_shared_work() of so many variables
/// @throws NumericalError if it does not converge
IteratedModes shared_free_modes(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                                const Sieve& sieve, double first_shift, int count,
                                double tolerance);

}  // namespace buckens::body
