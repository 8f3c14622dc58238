// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Weights of the combination of vectors X that has the least Rayleigh quotient of K and M.
/// Vectors of which little mass is left beyond the others add nothing.
/// @param M,K XᵀMX and XᵀKX
/// @return zero where there is no mass
linalg::Vector least_combination(const linalg::Matrix& M, const linalg::Matrix& K);

}  // namespace buckens::stepping
