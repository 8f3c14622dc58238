// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// A coordinate with its whole turns stored separately, so that no digits are lost after many.
struct CountedValue {
  int turns = 0;        ///< of an angle; 0 of a displacement
  double fraction = 0;  ///< angle within the turn, −π … π [rad], or displacement [m]

  /// The whole angle [rad] or displacement [m].
  double value() const;
};

/// Angle or displacement of marker M relative to marker F about or along an axis fixed in F, both
/// zero as placed; or the length of the line between them. The axis is also fixed in M if a joint
/// ensures that.
class JointCoordinate {
 public:
  enum class Kind { angle, displacement, length };

  /// @param axis_F unit vector in F, @param R_FM_placed orientation of M in F as placed
  static JointCoordinate angle(const Eigen::Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed);
  /// @param axis_F unit vector in F, @param r_F_placed position of M in F as placed [m]
  static JointCoordinate displacement(const Eigen::Vector3d& axis_F,
                                      const Eigen::Vector3d& r_F_placed);

  static JointCoordinate length();

  Kind kind() const { return kind_; }
  const Eigen::Vector3d& axis() const { return axis_F_; }

  /// Angle within the turn [rad], displacement or length [m].
  double fraction(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const;
  /// J: the rate of the coordinate is J V.
  spatial::PairRow derivatives(const spatial::MarkerMotion& F,
                               const spatial::MarkerMotion& M) const;
  /// Part of the coordinate's acceleration that does not come from those of the bodies'
  /// coordinates.
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M) const;
  /// The counted value closest to `before`.
  CountedValue follow(const CountedValue& before, double fraction) const;

 private:
  Kind kind_ = Kind::displacement;
  Eigen::Vector3d axis_F_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x_F_ = Eigen::Vector3d::UnitX();  // of an angle: perpendicular to the axis
  Eigen::Vector3d x_M_ = Eigen::Vector3d::UnitX();  // its image in M as placed
  double offset_ = 0;                               // of a displacement [m]
};

/// The counted angle that is reached from `before` on the shorter way.
/// @param fraction within the turn, −π … π [rad]
CountedValue follow_turns(const CountedValue& before, double fraction);

/// How far a coordinate has gone from one value to another, with all digits.
double difference(const CountedValue& from, const CountedValue& to);

}  // namespace buckens::joints
