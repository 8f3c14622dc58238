// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Slip at a place where two bodies strike each other.
struct ImpactSlip {
  Eigen::Index across = 0;  ///< row of the impulse P_n that presses them
  Eigen::Index first = 0;   ///< row of the first direction of slip; the second follows it
  Eigen::Index count = 1;   ///< of directions
  double coefficient = 0;   ///< μ
};

/// Impulses P of an impact with friction. The first rows are one-sided ones,
///
///     w = D P − b ≥ 0,   P ≥ 0,   Pᵀw = 0 (I1)
///
/// and those of each slip have D P − b = 0 with |P_t| ≤ μ P_n, or slide on with
///
///     |P_t| = μ P_n,   P_t = −|P_t| v/|v|,   v = D P − b (I2)
///
/// These are tried in turn: Newton's method with sweeps in between, place by place
/// (stepping/cone_impulse.h); sweeps alone; normal and friction impulses alternately until both
/// agree; impact by impact, which keeps the cones and separates the bodies, although a place may
/// have slid before it stuck; and, where places are wedged, convex problems
/// (stepping/cone_rounds.h). Places that influence each other are solved together, others
/// separately; large groups as in stepping/large_impact.h.
/// @param D of all rows, positive semidefinite, @param b for slips: minus the slip before
/// @param num_across number of one-sided rows
/// @param jammed takes the rows of places whose impulses are left out because friction holds what b
/// would separate: no finite impulses do both. Null: this is an error
/// @param are_near set if some impulses are those of ConeEnd::near
/// @throws StepFailure if no impulses are found: friction jams
linalg::Vector solve_impact(const linalg::SparseMatrix& D, const linalg::Vector& b,
                            Eigen::Index num_across, const std::vector<ImpactSlip>& slips,
                            std::vector<Eigen::Index>* jammed = nullptr, bool* are_near = nullptr);

}  // namespace buckens::stepping
