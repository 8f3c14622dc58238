// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/fe_model.h"
#include "buckens/fem/solid/block.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// The share of each node of an element in a uniform load on it, ∫ N dV.
struct NodeShares {
  std::vector<int> nodes;
  Eigen::VectorXd share;
};

/// Shares of the nodes of a solid element in its volume [m³]; may be negative.
NodeShares solid_shares(const SolidBlock& solids, const std::vector<Node>& nodes, int element);

/// Integral of the displacement along a line element times a weight, as rows over d:
/// ∫ w u dx = N d.
struct LineIntegral {
  double extent = 0;                                       ///< ∫ w dx
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();  ///< ∫ w s dx, model axes
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();        ///< model axes [m]
  std::vector<linalg::Triplet> rows;  ///< (0…2, DOF, value); the DOF may be −1
};
/// A uniform force on a beam also gives end moments, ± q l²/12, from its shape
/// functions.
/// @param line number among the line elements
LineIntegral line_integral(const FeModel& fe, int line, const Quartic& weight);

/// Mass per length and area of the section of a line element of a structure, from end to end.
struct LineSection {
  Quartic mass_per_length{};  ///< [kg/m]
  Quartic area{};             ///< [m²]
};
/// @param line beams first, then bars
LineSection line_section(const Structure& structure, int line);

}  // namespace buckens::fem
