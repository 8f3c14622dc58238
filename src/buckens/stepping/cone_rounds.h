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
  near,   ///< sliding places separate or approach at a millionth of the largest rate at most
  exact,  ///< (I1) and (I2) hold to rounding
};

/// Impulses that satisfy (I1) and (I2), by a series of convex problems (stepping/cone_program.h).
///
/// In each of these, sliding places separate at μ |w_t|. The normal components of b are therefore
/// reduced by this amount, with the slip of the previous round, until slips no longer change
/// (Cadoux 2009). This is slower than Newton's method and sweeps, but finds a solution where both
/// oscillate. In rare cases the rounds lead away from it; then sliding places may separate at a
/// millionth of the largest rate. Theory: docs/theory/23-impacts.md §3.
/// @param D of all rows, positive semidefinite
/// @param finish turns nearly exact impulses into exact ones; false: they are not near enough
/// @return whether impulses are found; never where places are driven against each other
ConeEnd find_in_cones(const linalg::SparseMatrix& D, const linalg::Vector& b,
                      const std::vector<ConeRows>& places,
                      const std::function<bool(linalg::Vector&)>& finish, linalg::Vector& P);

}  // namespace buckens::stepping
