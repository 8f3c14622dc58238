// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace buckens::loads {

/// Parameters of LuGre's bristles.
struct BristleData {
  double stiffness = 0;      ///< σ₀ [N/m] or [N m/rad]
  double damping = 0;        ///< σ₁ [N s/m] or [N m s/rad]
  double elastic_share = 0;  ///< κ
};

/// α of bristles that are bent with the way. @param filled their share of the deflection at which
/// they slide, @param elastic_share κ > 0
double sliding_share(double filled, double elastic_share);
/// dα by the same.
double sliding_share_slope(double filled, double elastic_share);

/// dz/ds of bristles where s grows, (R18). @param z deflection, @param sliding deflection f_s/σ₀ at
/// which they slide
double slope_of_bristles(double z, double sliding, double elastic_share);

/// Deflection after a way along which they were bent by z.
/// @param sliding deflections at which they slide, at its start and at its end
double bent_over(double way, double z, const std::array<double, 2>& sliding, double elastic_share);

// Parts of the deflection at which bristles slide that one step of their integration covers, and
// way over which they have surely come to slide.
inline constexpr double kPartOfBend = 0.1;
inline constexpr double kSurelySliding = 60.0;
// A bound that all but vanishes within a step counts as this share of its mean.
inline constexpr double kLeastBound = 0.1;
// Slope dz/ds above which they count as elastic; below half of it they nearly slide.
inline constexpr double kHardlyBent = 0.5;
// Of differences by the load: far above rounding, and what they leave out is of its square.
inline constexpr double kHeavier = 1e-6;

}  // namespace buckens::loads
