// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/joints/coordinate_measure.h"

namespace buckens::joints {

class GapLaw;

/// Angle or displacement of marker M relative to marker F about or along an axis fixed in F, both
/// zero as placed; the distance between them; the gap between M and a curve fixed in F; or a
/// CoordinateMeasure. The axis is also fixed in M if a joint ensures that. The second angle of a
/// cross joint is about an axis fixed in M.
class JointCoordinate {
 public:
  enum class Kind { angle, displacement, second_angle, length, gap, measured };

  /// @param axis_F unit vector in F, @param R_FM_placed orientation of M in F as placed
  static JointCoordinate angle(const Eigen::Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed);
  /// Both angles of a cross joint with perpendicular arms: θ₁ about the arm b fixed in F, θ₂ about
  /// the arm c fixed in M,
  ///
  ///     R_FM = exp(θ₁ b) exp(θ₂ c) R_FM_placed,   θ̇₁ = b·(ω_M − ω_F),  θ̇₂ = c·(ω_M − ω_F)  (R33)
  ///
  /// @param arm_F b, unit vector in F, @param other_F c as placed, unit vector in F
  static JointCoordinate first_angle(const Eigen::Vector3d& arm_F, const Eigen::Vector3d& other_F,
                                     const Eigen::Matrix3d& R_FM_placed);
  static JointCoordinate second_angle(const Eigen::Vector3d& arm_F, const Eigen::Vector3d& other_F,
                                      const Eigen::Matrix3d& R_FM_placed);
  /// @param axis_F unit vector in F, @param r_F_placed position of M in F as placed [m]
  static JointCoordinate displacement(const Eigen::Vector3d& axis_F,
                                      const Eigen::Vector3d& r_F_placed);

  static JointCoordinate length();
  /// Zero on the curve, positive on its free side.
  static JointCoordinate gap(std::shared_ptr<const GapLaw> law);
  static JointCoordinate measured(std::shared_ptr<const CoordinateMeasure> measure);

  Kind kind() const { return kind_; }
  /// Whether it is an angle [rad] rather than a length [m].
  bool is_angle() const { return is_angle_; }
  /// After what it repeats, so that turns must be counted [rad] or [m]; 0: it does not.
  double turn() const { return turn_; }
  /// The axis in F; of a second angle as placed; zero if there is no axis.
  const Eigen::Vector3d& axis() const { return axis_F_; }

  // Of measured coordinates, `before` says where they were a step before or are to be expected;
  // null: not known.

  /// Angle within the turn [rad], displacement, length or gap [m].
  double fraction(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                  const CountedValue* before = nullptr) const;
  /// J: the rate of the coordinate is J V.
  spatial::PairRow derivatives(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                               const CountedValue* before = nullptr) const;
  /// Both and the rate, at less cost than separate calls.
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before = nullptr) const;
  /// Part of the coordinate's acceleration that is independent of the accelerations of the bodies'
  /// coordinates.
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before = nullptr) const;
  /// The law of a gap, otherwise null.
  const GapLaw* gap_law() const { return gap_.get(); }
  /// Where it is to be expected at t; what counts no turns, where it was.
  CountedValue expect(const CountedValue& before, double t) const {
    if (turn_ > 0.0) return spatial::expected_at(before, t);
    return {before.turns, before.fraction, before.rate, t};
  }
  /// The counted value closest to the one expected.
  CountedValue follow(const CountedValue& expected, double fraction) const {
    if (is_angle_) return spatial::follow_turns(expected, fraction);
    return {expected.turns, fraction, expected.rate, expected.t};
  }

 private:
  /// The current axis.
  Eigen::Vector3d axis_now(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const {
    return kind_ == Kind::second_angle ? Eigen::Vector3d(M.R * axis_M_)
                                       : Eigen::Vector3d(F.R * axis_F_);
  }

  Kind kind_ = Kind::displacement;
  bool is_angle_ = false;
  double turn_ = 0;
  Eigen::Vector3d axis_F_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x_F_ = Eigen::Vector3d::UnitX();     // of an angle: perpendicular to the axis
  Eigen::Vector3d x_M_ = Eigen::Vector3d::UnitX();     // its image in M as placed
  Eigen::Vector3d axis_M_ = Eigen::Vector3d::UnitZ();  // of a second angle
  double offset_ = 0;                                  // of a displacement [m]
  std::shared_ptr<const GapLaw> gap_;                  // of a gap
  std::shared_ptr<const CoordinateMeasure> measure_;   // of what is measured
};

}  // namespace buckens::joints
