// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/state.h"

namespace buckens::dynamics {

/// Inertial coupling of a flexible body at the given motion, FM (19), (21)–(24): moments for the
/// frame equation and nodal loads. For the level `none` the moments of the undeformed body and no
/// load.
model::Coupling evaluate_coupling(const body::Body& body, const linalg::Vector& d,
                                  const linalg::Vector& d_dot, const linalg::Vector& d_ddot,
                                  const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot);

/// Coupling at t + ratio·(t − t_before) by linear extrapolation.
model::Coupling extrapolate(const model::Coupling& now, const model::Coupling& before,
                            double ratio);

}  // namespace buckens::dynamics
