// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"

namespace buckens::dynamics {

/// Moments of the undeformed body: what the coupling level `none` and rigid bodies use.
body::DeformedMoments undeformed_moments(const body::Body& body);

/// Left-hand side of the frame equations, FM (17), (19):
///
///     J ẇ + Cᵀd̈ + J̇ w + w × (J w + l)   [N m, body axes]
///     m v̇                                [N, world axes]
Eigen::Matrix<double, 6, 1> frame_inertia(const body::Body& body,
                                          const body::DeformedMoments& moments,
                                          const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot,
                                          const Eigen::Vector3d& v_dot);

/// Derivative of the rotational part with respect to w: J̇ + w~J − (J w + l)~.
Eigen::Matrix3d gyroscopic_tangent(const body::DeformedMoments& moments, const Eigen::Vector3d& w);

}  // namespace buckens::dynamics
