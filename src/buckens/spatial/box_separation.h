// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/touch_surface.h"

namespace buckens::spatial {

/// The direction in which two boxes are apart, or overlap least: normal to a face of either, or to
/// an edge of both.
///
/// Faces of the first win where the difference is below a thousandth of the smaller box, so that
/// rounding does not choose between faces that lie on each other.
struct BoxSeparation {
  enum class Feature { first_face, second_face, edges };

  double gap = -HUGE_VAL;                             ///< negative: they overlap [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< from the first to the second
  Feature feature = Feature::first_face;
  int axis = -1;  ///< of the face, or along the edge of the first
  int edge = -1;  ///< axis along the edge of the second

  /// @param A,B orientations of the boxes, @param r from the middle of the first to the second
  static BoxSeparation of(const TouchSurface& first, const Eigen::Matrix3d& A,
                          const TouchSurface& second, const Eigen::Matrix3d& B,
                          const Eigen::Vector3d& r);
};

}  // namespace buckens::spatial
