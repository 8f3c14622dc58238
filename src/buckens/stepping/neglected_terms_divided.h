// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/model/state.h"
#include "buckens/stepping/divided_body.h"

namespace buckens::stepping {

/// What neglected_share() compares: norms of sieved loads, √(Σ (Yᵀf)ᵢ²/K̂ᵢᵢ), and a torque.
struct NeglectedSizes {
  double inertia = 0;                                ///< M d̈
  double internal = 0;                               ///< K d + C ḋ
  double applied = 0;                                ///< loads of joints and force elements
  double neglected = 0;                              ///< nodal loads of the terms that are not kept
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< of these on the frame [N m]
};

/// Those of a body whose vectors other processes have: two programs, from which sums come.
/// Arguments as of neglected_share().
NeglectedSizes neglected_sizes(const body::Body& body, const DividedBody& there,
                               const model::BodyState& state, const body::CouplingTerms& kept,
                               const linalg::Vector* interface_load);

}  // namespace buckens::stepping
