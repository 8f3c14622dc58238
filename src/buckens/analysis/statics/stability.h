// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/analysis/statics/system.h"

namespace buckens::analysis {

/// Stiffness of an equilibrium along the motions that the joints allow, per mass of the frames.
struct StaticModes {
  linalg::Vector stiffness;  ///< κ [1/s²], ascending: below zero unstable, zero without restoring
  linalg::Matrix shapes;     ///< scaled steps (frames, interfaces, multipliers), one column each
  double tolerance = 0;      ///< |κ| below this is zero to within finite differences
};

/// Solves (A − κ W) u = 0 on the motions u of the frames that keep the joints closed, with the
/// meshes following statically. A is the tangent of the last linearise(), symmetrised.
///
/// Dense in the frame coordinates, one solve each.
/// @param sigma shift > 0 of the order of the relevant κ [1/s²], @param stands closed rows of
/// RestRows count as joints
/// @return empty above 600 frame coordinates, or if A + σW is singular
std::optional<StaticModes> static_modes(const StaticSystem& system, double sigma,
                                        const RestStands& stands);

/// Only the softest of these motions, by inverse iteration: for any number of frame coordinates.
/// Accurate to a few digits, which distinguishes a mechanism from a soft spring.
/// @return empty if A + σW is singular
std::optional<StaticModes> softest_mode(const StaticSystem& system, double sigma,
                                        const RestStands& stands);

/// "(0, 0, 1)": a unit vector to three digits.
std::string direction_text(const Eigen::Vector3d& direction);

/// "body "arm" turns about (0, 0, 1)": the largest motion of a frame in a step, world axes.
std::string describe_motion(const model::Model& model, const StaticSystem& system,
                            const StaticPoint& point, const linalg::Vector& step);

/// The same for motions that occur together, such as all those without restoring force: "in any
/// direction" and "about any axis" if there is no single one. @param steps one column each, the
/// first determines which body moves most
std::string describe_motions(const model::Model& model, const StaticSystem& system,
                             const StaticPoint& point, const linalg::Matrix& steps);

}  // namespace buckens::analysis
