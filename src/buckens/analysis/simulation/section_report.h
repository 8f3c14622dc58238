// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/fe_model.h"

namespace buckens::analysis {

/// Orientation of the section of a beam in a planar model, in which it only bends in the plane.
struct PlanarBending {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< normal of the plane, model axes of the body
  double EI = 0;                                    ///< about it [N m²]
  double extent_in_plane = 0;                       ///< of the section, across the beam [m]
  double extent_across = 0;                         ///< of the section, along the normal [m]
};

/// Bending directions of a beam: elements with the same section in the same orientation.
struct SectionReport {
  int elements = 0;  ///< how many
  /// Of the first of them, model axes, unit length: `y` along the width of the section, `z` along
  /// its height (the `up` direction).
  Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  double width = 0;   ///< extent along y [m]; for a `general` section that of its stress points
  double height = 0;  ///< extent along z [m]
  double EI_y = 0;    ///< about y: bending along the height [N m²]
  double EI_z = 0;    ///< about z: bending along the width [N m²]
  std::optional<PlanarBending> planar;  ///< only in planar models
};

/// Reports on the beams of a mesh; tapered elements by their middle. Elements that differ only in
/// their line share an entry.
/// @param normal of the plane of a planar model, in model axes of the body
std::vector<SectionReport> report_sections(const fem::FeModel& fe,
                                           const std::optional<Eigen::Vector3d>& normal);

}  // namespace buckens::analysis
