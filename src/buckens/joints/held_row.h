// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/row_law.h"

namespace buckens::joints {

/// One row of a weld that holds its markers as they were when it was attached.
///
///     g = e·(ρ − ρ₀)  or  g = b·(R_FM c₀)                                                   (R35)
///
/// with M's place ρ in F, directions e and b of F, and ρ₀ and c₀ as placed, or as found when an
/// event attached the joint: its states.
class HeldRow final : public RowLaw {
 public:
  /// @param e_F unit vector in F, @param r_F from F to M as placed
  static HeldRow place(const Eigen::Vector3d& e_F, const Eigen::Vector3d& r_F);
  /// @param b_F,c_F perpendicular unit vectors in F, @param R_FM as placed
  static HeldRow turn(const Eigen::Vector3d& b_F, const Eigen::Vector3d& c_F,
                      const Eigen::Matrix3d& R_FM);

  int num_states() const override { return 4; }
  bool turns_second() const override { return !is_place_; }
  bool is_length() const override { return is_place_; }
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;
  void attach(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
              double* states) const override;

 private:
  /// ρ₀ or c₀.
  Eigen::Vector3d held(const double* states) const;

  bool is_place_ = true;
  Eigen::Vector3d b_F_ = Eigen::Vector3d::UnitX();  // or e
  Eigen::Vector3d c_F_ = Eigen::Vector3d::UnitY();
  Eigen::Vector3d placed_ = Eigen::Vector3d::Zero();  // ρ₀ or c₀ as placed
};

}  // namespace buckens::joints
