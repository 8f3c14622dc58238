// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/time_law.h"

namespace buckens::joints {

/// A smooth curve through points: cubic splines of the length along the chords, natural at the ends
/// of an open curve.
///
/// Beyond the ends of an open curve it goes on straight, so that an iteration may look there; a
/// closed one is periodic.
class SpaceCurve {
 public:
  struct Point {
    Eigen::Vector3d p, tangent, curvature;  ///< c, c′, c″ by the parameter
  };

  /// @param points two or more, of a closed curve three or more; neighbours apart
  /// @throws ModelError if there are too few, or two in a row are the same
  SpaceCurve(const std::vector<Eigen::Vector3d>& points, bool is_closed);

  /// @param s length along the chords from the first point [m]
  Point at(double s) const;

  double length() const { return length_; }
  bool is_closed() const { return is_closed_; }

  /// The parameter of the nearest point, sought from a guess by Newton's method.
  /// @param across directions out of which distances are not counted, or zero
  double nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& across, double guess) const;
  /// The same without a guess: from the nearest of many points.
  double nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& across) const;

 private:
  std::array<base::TimeLaw, 3> laws_;
  double length_ = 0;
  bool is_closed_ = false;
  int samples_ = 0;
};

}  // namespace buckens::joints
