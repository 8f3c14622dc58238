// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bristle_bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

/// α of bristles that are bent with the way. @param filled their share of the deflection at which
/// they slide, @param elastic_share > 0
double sliding_share(double filled, double elastic_share) {
  if (filled <= elastic_share) return 0.0;
  const double middle = 0.5 * (1.0 + elastic_share);
  const double width = 1.0 - elastic_share;
  if (filled < 1.0 && width > 0.0) {
    return 0.5 + 0.5 * std::sin(std::numbers::pi * (filled - middle) / width);
  }
  return 1.0;
}

// Parts of the deflection at which bristles slide that one step of their integration covers, and
// way over which they have surely come to slide.
constexpr double kPartOfBend = 0.1;
constexpr double kSurelySliding = 60.0;
// A bound that all but vanishes within a step counts as this share of its mean.
constexpr double kLeastBound = 0.1;

/// Deflection after a way, by the method of Runge and Kutta.
/// @param slope dz/ds of (z, deflection at which they slide)
template <class Deflection, class Slope>
Deflection integrate(double way, Deflection z, const std::array<double, 2>& sliding,
                     const Slope& slope) {
  const double from = sliding[0], to = sliding[1];
  const double mean = 0.5 * (from + to);
  const int count = static_cast<int>(std::ceil(way / (kPartOfBend * mean)));
  const double ds = way / count;
  const auto at = [&](double part, const Deflection& bent) -> Deflection {
    const double now = from + (to - from) * part / count;
    return slope(bent, std::max(now, kLeastBound * mean));
  };
  for (int k = 0; k < count; ++k) {
    const Deflection a = at(k, z);
    const Deflection b = at(k + 0.5, z + 0.5 * ds * a);
    const Deflection c = at(k + 0.5, z + 0.5 * ds * b);
    const Deflection d = at(k + 1, z + ds * c);
    z += ds / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return z;
}

bool surely_slide(double way, const std::array<double, 2>& sliding) {
  return way > kSurelySliding * std::max(sliding[0], sliding[1]);
}

}  // namespace

double slope_of_bristles(double z, double sliding, double elastic_share) {
  const double filled = z / sliding;
  // Bent against the way: elastic, but for LuGre's law itself, where they straighten faster.
  if (filled <= 0.0) return elastic_share > 0.0 ? 1.0 : 1.0 - filled;
  const double alpha = elastic_share > 0.0 ? sliding_share(filled, elastic_share) : 1.0;
  return 1.0 - alpha * filled;
}

Vector3d slope_of_bristles(const Vector3d& z, const Vector3d& ahead, double sliding,
                           double elastic_share) {
  if (elastic_share == 0.0) return ahead - z / sliding;
  const double size = z.norm();
  const double along = ahead.dot(z);
  if (!(along > 0.0)) return ahead;
  const double filled = size / sliding;
  return ahead - sliding_share(filled, elastic_share) * (along / size) * filled * (z / size);
}

double bent_over(double way, double z, const std::array<double, 2>& sliding, double elastic_share) {
  if (surely_slide(way, sliding)) return sliding[1];
  if (way == 0.0) return z;
  z = integrate(way, z, sliding, [&](double bent, double now) {
    return slope_of_bristles(bent, now, elastic_share);
  });
  return way > kSurelySliding * sliding[1] ? std::min(z, sliding[1]) : z;
}

Vector3d bent_over(const Vector3d& way, const Vector3d& z, const std::array<double, 2>& sliding,
                   double elastic_share) {
  const double length = way.norm();
  if (length == 0.0) return z;
  const Vector3d ahead = way / length;
  if (surely_slide(length, sliding)) return sliding[1] * ahead;
  const Vector3d out = integrate(length, z, sliding, [&](const Vector3d& bent, double now) {
    return slope_of_bristles(bent, ahead, now, elastic_share);
  });
  const double size = out.norm();
  const bool is_too_far = length > kSurelySliding * sliding[1] && size > sliding[1];
  return is_too_far ? Vector3d(out * (sliding[1] / size)) : out;
}

}  // namespace buckens::loads
