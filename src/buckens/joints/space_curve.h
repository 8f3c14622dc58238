// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/time_law.h"
#include "buckens/joints/curve_pieces.h"

namespace buckens::joints {

/// A smooth curve: cubic splines through points, of the length along the chords, natural at the
/// ends of an open curve; or straight lines and arcs one after the other, of the length along them.
///
/// Beyond the ends of an open curve it goes on straight, so that an iteration may look there; a
/// closed one is periodic.
class SpaceCurve {
 public:
  using Point = CurvePoint;

  /// @param points two or more, of a closed curve three or more; neighbours apart
  /// @throws ModelError if there are too few, or two in a row are the same
  SpaceCurve(const std::vector<Eigen::Vector3d>& points, bool is_closed);
  /// @throws ModelError if they do not meet smoothly
  SpaceCurve(const CurvePieces& pieces, bool is_closed);

  /// @param s length from the first point [m]
  Point at(double s) const;

  double length() const { return length_; }
  /// Parameters from 0 to length() between which the curve is smooth to any order.
  const std::vector<double>& knots() const { return knots_; }
  bool is_closed() const { return is_closed_; }

  /// The parameter of the nearest point, sought from a guess by Newton's method.
  /// @param across directions out of which distances are not counted, or zero
  double nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& across, double guess) const;
  /// The same without a guess: from the nearest of many points.
  double nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& across) const;

 private:
  Point inside(double s) const;
  /// Points from which the nearest is sought.
  void sample(double from, double to, int count);

  std::array<base::TimeLaw, 3> laws_;  // of a spline
  CurvePieces pieces_;
  double length_ = 0;
  bool is_closed_ = false;
  std::vector<double> knots_;
  std::vector<double> sampled_;
  std::vector<Eigen::Vector3d> places_;
};

}  // namespace buckens::joints
