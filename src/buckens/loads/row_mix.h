// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::loads {

/// Coupling of the soft rows of one element that has slip between them. The force of row i is then
/// given by
///
///     f_i = Σ_j R_ij f̂_j
///
/// with f̂_j the force from stiffness and damping of row j alone. Without slip R is the identity; a
/// row that only follows others makes it singular and not symmetric.
using RowMix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;

}  // namespace buckens::loads
