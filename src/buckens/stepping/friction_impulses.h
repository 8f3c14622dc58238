// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Where two bodies that strike each other slip.
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
/// By Newton's method with sweeps between, place by place (stepping/cone_impulse.h). Where that has
/// no end, sweeps alone; then each set with the impulses of the other one until both agree; then
/// blow by blow, which keeps the cones and parts the bodies, but a place may have rubbed before it
/// stuck; then, where places wedge each other, by convex problems (stepping/cone_rounds.h).
/// Places that answer each other are solved together, others by themselves; many of them as in
/// stepping/large_impact.h.
/// @param D of all rows, positive semidefinite, @param b of slips: minus the speed of slip before
/// @param num_across number of one-sided rows
/// @param jammed takes the rows of places whose impulses are left out since friction holds what b
/// would part: no finite impulses do both. Null: that is an error
/// @param are_near set where some are those of ConeEnd::near
/// @throws StepFailure if they do not come to an agreement: friction that jams
linalg::Vector solve_impact(const linalg::SparseMatrix& D, const linalg::Vector& b,
                            Eigen::Index num_across, const std::vector<ImpactSlip>& slips,
                            std::vector<Eigen::Index>* jammed = nullptr, bool* are_near = nullptr);

}  // namespace buckens::stepping
