// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>

#include "buckens/joints/row_law.h"
#include "buckens/joints/turn_sum.h"

namespace buckens::joints {

/// Pressure angle in the plane across the axes, from that normal to the teeth [rad].
double transverse_angle(double pressure_angle, double helix_angle);

/// Two wheels that turn with each other: gears with involute teeth, or pulleys of a belt.
///
/// Angles φ of both wheels are counted against the line between their centres, so that centres may
/// move: a carrier needs no name, and bearings may be elastic.
///
///     g = k (z₁ φ₁ ± z₂ φ₂) + s (w(C) − w(C₀)) + cos α_t tan β (z − z₀) = 0                  (R8)
///     w(C) = √(C² − R²) − R acos(R/C),   dw/dC = sin α′
///
/// with the distance of centres C, base radii k z, R the distance at which base circles would
/// touch, α′ the working pressure angle and z the displacement along the axis. This is the length
/// of the line of action, so its multiplier is the force between the teeth along it, and the
/// bearings feel all of it. Teeth push each other away: s, the flank that carries, follows the sign
/// of the multiplier from step to step.
class GearMesh final : public RowLaw {
 public:
  struct Data {
    Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();   ///< unit vector
    Eigen::Vector3d r_F = Eigen::Vector3d::UnitX();      ///< from F to M as placed [m]
    Eigen::Matrix3d R_FM = Eigen::Matrix3d::Identity();  ///< as placed
    std::array<double, 2> sizes{1, 1};                   ///< z: teeth, or radii of pulleys [m]
    bool same_sense = false;                             ///< internal gears, open belts
    bool has_teeth = true;                               ///< pulleys have none
    double pressure_angle = 0;                           ///< normal to the teeth, α [rad]
    double helix_angle = 0;                              ///< β, first wheel right-handed [rad]
  };
  /// @throws ModelError if the centres coincide across the axis
  explicit GearMesh(const Data& data);

  // Both angles, the instant to which they belong, and which flank carries.
  static constexpr int kInstant = 6, kFlank = 7, kStates = 8;
  int num_states() const override { return kStates; }
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;

  /// From tooth to tooth along the line of action [m].
  double pitch() const { return 2.0 * std::numbers::pi * base_; }

 private:
  struct View;
  View look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
            const double* states) const;

  Eigen::Vector3d axis_F_, u_F_, u_M_;  // u: from first to second centre as placed
  std::array<double, 2> sizes_;         // signed: same sense is minus
  double base_ = 1;                     // k, base radius per size [m]
  double distance_ = 0;                 // C₀
  double touching_ = 0;                 // R
  double flank_sign_ = 0;               // of s for a multiplier above zero; 0: no flanks
  double axial_ = 0;                    // cos α_t tan β
  double offset_ = 0;                   // z₀
};

/// A toothed rack (marker F) and its pinion (marker M).
///
///     g = r cos α_t θ − cos α_t (x − x₀) + s sin α_t (y − y₀) + cos α_t tan β (z − z₀) = 0    (R9)
///
/// with the pinion's place (x, y, z) in axes of the rack: along it, away from its teeth, and along
/// the pinion's axis. Multiplier and s as of gears.
class RackMesh final : public RowLaw {
 public:
  struct Data {
    Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();   ///< of the pinion, unit vector
    Eigen::Vector3d along_F = Eigen::Vector3d::UnitX();  ///< unit vector across it
    Eigen::Vector3d r_F = Eigen::Vector3d::Zero();       ///< from F to M as placed [m]
    Eigen::Matrix3d R_FM = Eigen::Matrix3d::Identity();
    double radius = 1;  ///< of the pitch circle [m]
    double pressure_angle = 0;
    double helix_angle = 0;
  };
  explicit RackMesh(const Data& data);

  // The angle, the instant to which it belongs, and which flank carries.
  static constexpr int kInstant = 3, kFlank = 4, kStates = 5;
  int num_states() const override { return kStates; }
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;

  /// What a turn of the pinion adds along the line of action [m].
  double turn() const { return 2.0 * std::numbers::pi * base_; }

 private:
  CountedValue angle(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                     const double* states) const;
  Eigen::Vector3d line_of_action(const double* states) const;

  Eigen::Vector3d axis_F_, x_F_, x_M_, r_F_;
  Eigen::Vector3d driving_, separating_;  // share of the line of action, in F
  double base_ = 1;                       // r cos α_t
};

}  // namespace buckens::joints
