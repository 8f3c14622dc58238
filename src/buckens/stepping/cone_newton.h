// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Rows of one place where bodies touch: across first, then along.
struct ConeRows {
  std::vector<Eigen::Index> rows;
  double coefficient = 0;  ///< μ
};

/// What impulses of friction do at most to one rate, by the rates that they are to change: beyond
/// it they cancel out to more digits than half of theirs. Rows hold the same there, and friction
/// jams.
inline constexpr double kMostCancelled = 1e8;

/// How the force of a place slides along its cone: most · towards, of which `turns` is the
/// derivative with respect to the force on trial.
struct SlidingCone {
  double most = 0;  ///< μ d P_n
  linalg::Vector towards;
  linalg::Matrix turns;
};

/// @param trial d P_t − w_t of a place that is pressed, @param pressed d P_n
/// @return empty: the cone admits it, the place sticks
std::optional<SlidingCone> sliding_cone(const linalg::Vector& trial, double coefficient,
                                        double pressed);

/// Newton's method on (I1) and (I2) of all places at once, by the projections of Alart and Curnier:
/// a few solutions of a linear system where it converges, which it need not.
/// @param D of all rows, positive semidefinite, @param P start and result
/// @return whether P satisfies them but for rounding
bool find_by_newton(const linalg::Matrix& D, const linalg::Vector& b,
                    const std::vector<ConeRows>& places, linalg::Vector& P);

}  // namespace buckens::stepping
