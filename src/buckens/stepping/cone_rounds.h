// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/stepping/cone_newton.h"

namespace buckens::stepping {

/// How rounds over convex problems end.
enum class ConeEnd {
  none,   ///< without impulses
  near,   ///< what slides parts or closes by a millionth of the largest rate at most
  exact,  ///< with (I1) and (I2) to rounding
};

/// Impulses that satisfy (I1) and (I2), by convex problems (stepping/cone_program.h): what slides
/// parts by μ |w_t| in these, so b is less by that across, with the slip of the round before, until
/// slips do not change any more (Cadoux 2009). Slower than Newton's method and sweeps, but it finds
/// an end where both go to and fro. Rarely rounds lead away from one; then places that slide may
/// part by a millionth of the largest rate.
/// @param D of all rows, positive semidefinite
/// @param finish makes exact what is nearly exact; false: it is not near enough
/// @return whether they are found; never where places are driven against each other
ConeEnd find_in_cones(const linalg::SparseMatrix& D, const linalg::Vector& b,
                      const std::vector<ConeRows>& places,
                      const std::function<bool(linalg::Vector&)>& finish, linalg::Vector& P);

}  // namespace buckens::stepping
