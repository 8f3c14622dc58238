// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Rows of one place where bodies touch: the normal row first ("across"), then those along the
/// surface.
struct ConeRows {
  std::vector<Eigen::Index> rows;
  double coefficient = 0;  ///< μ
};

/// Largest effect of friction impulses on a rate, relative to the rates that they have to change:
/// beyond it they cancel to more than half of their digits. Then rows hold the same thing, and
/// friction jams.
inline constexpr double kMostCancelled = 1e8;

/// Friction force of a place that slides: most · towards, where `turns` is the derivative of
/// `towards` with respect to the trial force.
struct SlidingCone {
  double most = 0;  ///< μ d P_n
  linalg::Vector towards;
  linalg::Matrix turns;
};

/// @param trial d P_t − w_t of a place that is pressed, @param pressed d P_n
/// @return empty if the cone admits the trial force: the place sticks
std::optional<SlidingCone> sliding_cone(const linalg::Vector& trial, double coefficient,
                                        double pressed);

/// Newton's method on (I1) and (I2) of all places at once, with the projections of Alart and
/// Curnier. If it converges, which is not guaranteed, it solves a few linear systems.
/// @param D of all rows, positive semidefinite, @param P start and result
/// @return whether P satisfies them to rounding
bool find_by_newton(const linalg::Matrix& D, const linalg::Vector& b,
                    const std::vector<ConeRows>& places, linalg::Vector& P);

}  // namespace buckens::stepping
