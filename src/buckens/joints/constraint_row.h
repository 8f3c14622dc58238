// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "buckens/base/time_law.h"
#include "buckens/joints/row_law.h"

namespace buckens::joints {

/// Target of a steered row: its value at an instant and its derivatives.
struct Steering {
  static constexpr int kStates = 5;
  double t = 0;             ///< the instant [s]
  double value = 0;         ///< [m] or [rad]
  double rate = 0;          ///< [m/s] or [rad/s]
  double acceleration = 0;  ///< [m/s²] or [rad/s²]

  void write(double* states) const {
    const double all[kStates] = {1.0, t, value, rate, acceleration};
    for (int k = 0; k < kStates; ++k) states[k] = all[k];
  }
  /// @param states may be null. @return whether they contain a target
  bool read(const double* states) {
    if (states == nullptr || states[0] == 0.0) return false;
    *this = {states[1], states[2], states[3], states[4]};
    return true;
  }
};

/// One scalar constraint between marker frames F (first) and M (second).
///
/// Every joint consists of rows of these kinds:
///   - `point_world`: e·(p_M − p_F) = 0 with e fixed in the world;
///   - `point_along`: (R_F e)·(p_M − p_F) − s₀ − s(t) = 0 with e fixed in F;
///   - `direction`: (R_F b(t))·(R_M c) = 0, b rotating about the axis a of F by a law of time if
///   there is one;
///   - `distance`:    |p_M − p_F| − L = 0;
///   - `homokinetic`: (R_F x)·(R_M y′) − (R_F y)·(R_M x′) = 0, x and y across the shafts;
///   - `screw`:       s − p θ/2π = 0 with displacement s along and angle θ about an axis of F;
///   - `law`:         given by a RowLaw, with memory from step to step;
///   - `coupled`:     a sum over coordinates of other joints. It acts on more than two markers and
///                    is evaluated from model::Joint::coupled; this class holds only its unit and
///                    its law of time;
///   - `travelling`:  between a marker and its current point on a beam, evaluated from
///                    model::Joint::track; this class holds only its number and its law of time.
class ConstraintRow {
 public:
  enum class Kind {
    point_world,
    point_along,
    direction,
    distance,
    homokinetic,
    screw,
    law,
    coupled,
    travelling
  };

  static ConstraintRow point_world(const Eigen::Vector3d& e);
  /// @param offset s₀ [m], @param displacement s(t) [m], zero if absent
  static ConstraintRow point_along(const Eigen::Vector3d& e_F, double offset = 0.0,
                                   std::optional<base::TimeLaw> displacement = std::nullopt);
  static ConstraintRow direction(const Eigen::Vector3d& b_F, const Eigen::Vector3d& c_M);
  /// M's direction c, which coincides with x_F when the angle is zero, rotated about `axis_F` by
  /// angle(t) [rad]. The residual is the sine of the angle error.
  static ConstraintRow turning(const Eigen::Vector3d& axis_F, const Eigen::Vector3d& x_F,
                               const Eigen::Vector3d& c_M, base::TimeLaw angle);

  /// @param length L [m], > 0
  static ConstraintRow distance(double length);
  /// Two directions perpendicular to the shaft of F, and two to that of M.
  static ConstraintRow homokinetic(const Eigen::Vector3d& x_F, const Eigen::Vector3d& y_F,
                                   const Eigen::Vector3d& x_M, const Eigen::Vector3d& y_M);
  /// The displacement is measured from the offset along the axis, the angle from where x_M
  /// coincides with a direction x_F perpendicular to the axis. Whole turns follow from the
  /// displacement and need not be counted.
  /// @param pitch p [m], not zero
  static ConstraintRow screw(const Eigen::Vector3d& axis_F, const Eigen::Vector3d& x_F,
                             const Eigen::Vector3d& x_M, double offset, double pitch);

  static ConstraintRow by_law(std::shared_ptr<const RowLaw> law);
  /// @param is_length whether the sum is a length or an angle, @param law its target, zero if
  ///        absent
  static ConstraintRow coupled(bool is_length, std::optional<base::TimeLaw> law = std::nullopt);
  /// @param number 0 and 1 across the beam, 2 along it
  /// @param displacement along the beam from s = 0 [m], for the row along it
  static ConstraintRow travelling(int number,
                                  std::optional<base::TimeLaw> displacement = std::nullopt);

  /// The same row, but following signals instead of a law of time. Its states hold the target
  /// (Steering); the evaluation of signals writes them.
  /// @param start target while its states are not set [m] or [rad]
  /// @pre depends_on_time(), of kind `point_along`, `direction`, `coupled` or `travelling`
  ConstraintRow steered(double start) const;

  /// @param states memory of a row of kind `law`, or target of a steered one; null: not
  ///        yet known
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states = nullptr) const;

  /// Part of g̈ that is independent of the accelerations of the bodies' coordinates.
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states = nullptr) const;

  Kind kind() const { return kind_; }
  /// True for rows whose residual is a length, false for dimensionless ones.
  bool is_length() const {
    return kind_ != Kind::direction && kind_ != Kind::homokinetic && !is_angle_ &&
           (!own_ || own_->is_length());
  }
  /// Whether the row transmits a moment to the first and to the second marker.
  bool turns_first() const {
    return kind_ != Kind::point_world && kind_ != Kind::distance && kind_ != Kind::coupled &&
           kind_ != Kind::travelling;
  }
  bool turns_second() const {
    return turns_first() && kind_ != Kind::point_along && (!own_ || own_->turns_second());
  }
  bool depends_on_time() const { return law_.has_value(); }
  /// The first row of a slider stores whether its position is known, and the position.
  int num_states() const {
    if (is_steered_) return Steering::kStates;
    if (kind_ == Kind::travelling) return number_ == 0 ? 2 : 0;
    return own_ ? own_->num_states() : 0;
  }
  /// Whether it constrains rates only, as in rolling, so that its residual is always zero.
  bool holds_rates_only() const { return own_ && own_->holds_rates_only(); }
  /// Of a travelling row.
  int number() const { return number_; }
  /// Whether it follows signals.
  bool is_steered() const { return is_steered_; }
  /// Target of a driven row. @param states of this row, may be null
  double driven_to(double t, const double* states) const;
  double driven_rate(double t, const double* states) const;
  double driven_acceleration(double t, const double* states) const;
  /// For rows of kind `law`, otherwise null.
  const RowLaw* law() const { return own_.get(); }
  /// e of a point row; b of a direction row, at angle zero if it turns.
  const Eigen::Vector3d& direction() const { return e_; }
  /// c of a direction row, in M.
  const Eigen::Vector3d& second_direction() const { return c_; }

 private:
  /// A vector b(t) fixed in F with its time derivatives there.
  struct TurningVector {
    Eigen::Vector3d value, rate, acceleration;
  };
  TurningVector turning_vector(double t, const double* states, bool with_acceleration) const;
  /// Rows of distance, homokinetic and screw. @param r from F to M
  void evaluate_coupling(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                         const Eigen::Vector3d& r, RowValue& out) const;
  double screw_residual(const Eigen::Vector3d& axis, const Eigen::Vector3d& r,
                        const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const;
  double distance_bias(const Eigen::Vector3d& r, const Eigen::Vector3d& r_dot,
                       const Eigen::Vector3d& a) const;

  Kind kind_ = Kind::point_world;
  Eigen::Vector3d e_ = Eigen::Vector3d::Zero();  // world axis, axis in F, or b at angle zero
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d c_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d e2_ = Eigen::Vector3d::Zero();  // y of F of a homokinetic row
  Eigen::Vector3d c2_ = Eigen::Vector3d::Zero();  // x of M of a homokinetic row
  double offset_ = 0;
  double pitch_ = 0;
  bool is_angle_ = false;  // of a coupled row
  int number_ = 0;         // of a travelling row
  bool is_steered_ = false;
  std::optional<base::TimeLaw> law_;
  std::shared_ptr<const RowLaw> own_;
};

}  // namespace buckens::joints
