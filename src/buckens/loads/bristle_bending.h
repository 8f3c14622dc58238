// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Dense>

namespace buckens::loads {

/// Parameters of LuGre's bristles.
struct BristleData {
  double stiffness = 0;      ///< σ₀ [N/m] or [N m/rad]
  double damping = 0;        ///< σ₁ [N s/m] or [N m s/rad]
  double elastic_share = 0;  ///< κ
};

/// dz/ds of bristles where s grows, (R18). @param z deflection, @param sliding deflection f_s/σ₀ at
/// which they slide
double slope_of_bristles(double z, double sliding, double elastic_share);
/// The same of a deflection in any direction, (R42). @param ahead unit vector of the way
Eigen::Vector3d slope_of_bristles(const Eigen::Vector3d& z, const Eigen::Vector3d& ahead,
                                  double sliding, double elastic_share);

/// Deflection after a way along which they were bent by z.
/// @param sliding deflections at which they slide, at its start and at its end
double bent_over(double way, double z, const std::array<double, 2>& sliding, double elastic_share);
Eigen::Vector3d bent_over(const Eigen::Vector3d& way, const Eigen::Vector3d& z,
                          const std::array<double, 2>& sliding, double elastic_share);

// Slope dz/ds above which they count as elastic; below half of it they nearly slide.
inline constexpr double kHardlyBent = 0.5;
// Of differences by the load: far above rounding, and what they leave out is of its square.
inline constexpr double kHeavier = 1e-6;

}  // namespace buckens::loads
