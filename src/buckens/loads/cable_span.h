// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// The free part of a cable between two pulleys or ends.
struct CableSpan {
  double centres = 0;     ///< distance of the centres across the axis [m]
  double length = 0;      ///< [m]; 0: it cannot be formed
  Eigen::Vector3d along;  ///< unit vector across the axis, in the direction of the cable
  Eigen::Vector3d left;   ///< unit vector, axis × along: from it, a positive radius is to the left
  /// Of the elongation while nothing slips, with respect to the twists of both markers.
  TwistRow on_from = TwistRow::Zero(), on_to = TwistRow::Zero();
  Eigen::Vector3d lengthens;  ///< derivative of the length by the second centre
  Eigen::Vector3d turns;      ///< of the angle of `along` about the axis by the second centre

  bool exists() const { return length > 0.0; }
  double length_rate(const spatial::MarkerMotion& from, const spatial::MarkerMotion& to) const {
    return lengthens.dot(to.v - from.v);
  }
  double turn_rate(const spatial::MarkerMotion& from, const spatial::MarkerMotion& to) const {
    return turns.dot(to.v - from.v);
  }

  /// @param from_radius,to_radius positive: the cable runs counter-clockwise around the axis there;
  /// 0: an end [m]
  static CableSpan between(const spatial::MarkerMotion& from, double from_radius,
                           const spatial::MarkerMotion& to, double to_radius,
                           const Eigen::Vector3d& axis);
};

}  // namespace buckens::loads
