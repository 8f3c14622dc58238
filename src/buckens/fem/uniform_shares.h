// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/fe_model.h"
#include "buckens/fem/solid_block.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// What each node of an element has of a uniform load on it, ∫ N dV.
struct NodeShares {
  std::vector<int> nodes;
  Eigen::VectorXd share;
};

/// Shares of the nodes of a solid element in its volume [m³]; they may be negative.
NodeShares solid_shares(const SolidBlock& solids, const std::vector<Node>& nodes, int element);

/// Integral of the displacement along a line element, as rows over d: ∫ u dx = N d.
struct LineIntegral {
  double length = 0;                                 ///< [m]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< model axes [m]
  std::vector<linalg::Triplet> rows;                 ///< (0…2, DOF, value); the DOF may be −1
};
/// A uniform force on a beam gives moments at its ends besides, ± q l²/12, as its shape functions
/// say.
/// @param line number among the line elements
LineIntegral line_integral(const FeModel& fe, int line);

/// Mass per length and area of the section of a line element of a structure.
struct LineSection {
  double mass_per_length = 0;  ///< [kg/m]
  double area = 0;             ///< [m²]
};
/// @param line beams first, then bars
LineSection line_section(const Structure& structure, int line);

}  // namespace buckens::fem
