// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Dense>

namespace buckens::loads {

/// How the bristles of a ball bend: their deflection z is the rotation vector from where they are
/// anchored, and anchors slip. For a rotation at the rate ω, with n = z/|z| and (x)₊ = max(x, 0),
///
///     ż = J_l(z)⁻¹ ω − α(|z|) (|z|/z_s) (ω·n)₊ n
///
/// Without slip z depends on the pose alone: nothing creeps, whatever the way to that pose. κ = 0
/// is LuGre's own law, ż = J_l(z)⁻¹ ω − |ω| z/z_s. Theory: docs/theory/22-rows.md §4.
class BallBending {
 public:
  /// @param elastic_share κ
  explicit BallBending(double elastic_share) : share_(elastic_share) {}

  /// ż. @param sliding z_s [rad]
  Eigen::Vector3d rate(const Eigen::Vector3d& z, const Eigen::Vector3d& w, double sliding) const;
  struct Slopes {
    Eigen::Matrix3d by_rate, by_z;
  };
  /// Derivatives of the same.
  Slopes slopes(const Eigen::Vector3d& z, const Eigen::Vector3d& w, double sliding) const;

  /// A rotation within a step, which bends.
  struct Way {
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();  ///< rotation vector ψ [rad]
    Eigen::Vector3d z = Eigen::Vector3d::Zero();       ///< before [rad]
    std::array<double, 2> sliding{};                   ///< z_s before and after [rad], > 0
  };
  /// The deflection after it.
  Eigen::Vector3d after(const Way& way) const;
  /// Derivatives of the same by a small rotation at the end of the way.
  Eigen::Matrix3d by_turn(const Way& way) const;

 private:
  /// Whether nothing slips on the way to this deflection.
  bool is_elastic(const Way& way, const Eigen::Vector3d& z) const;

  double share_;
};

}  // namespace buckens::loads
