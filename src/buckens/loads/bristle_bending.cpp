// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bristle_bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace buckens::loads {

double sliding_share(double filled, double elastic_share) {
  if (filled <= elastic_share) return 0.0;
  const double middle = 0.5 * (1.0 + elastic_share);
  const double width = 1.0 - elastic_share;
  if (filled < 1.0 && width > 0.0) {
    return 0.5 + 0.5 * std::sin(std::numbers::pi * (filled - middle) / width);
  }
  return 1.0;
}

double sliding_share_slope(double filled, double elastic_share) {
  if (filled <= elastic_share || filled >= 1.0) return 0.0;
  const double middle = 0.5 * (1.0 + elastic_share);
  const double turn = std::numbers::pi / (1.0 - elastic_share);
  return 0.5 * turn * std::cos(turn * (filled - middle));
}

double slope_of_bristles(double z, double sliding, double elastic_share) {
  const double filled = z / sliding;
  // Bent against the way: elastic, but for LuGre's law itself, where they straighten faster.
  if (filled <= 0.0) return elastic_share > 0.0 ? 1.0 : 1.0 - filled;
  const double alpha = elastic_share > 0.0 ? sliding_share(filled, elastic_share) : 1.0;
  return 1.0 - alpha * filled;
}

double bent_over(double way, double z, const std::array<double, 2>& sliding, double elastic_share) {
  const double from = sliding[0], to = sliding[1];
  if (way > kSurelySliding * std::max(from, to)) return to;
  if (way == 0.0) return z;
  const double mean = 0.5 * (from + to);
  const int count = static_cast<int>(std::ceil(way / (kPartOfBend * mean)));
  const double ds = way / count;
  const auto slope = [&](double part, double bent) {
    const double now = from + (to - from) * part / count;
    return slope_of_bristles(bent, std::max(now, kLeastBound * mean), elastic_share);
  };
  for (int k = 0; k < count; ++k) {  // Runge-Kutta
    const double a = slope(k, z);
    const double b = slope(k + 0.5, z + 0.5 * ds * a);
    const double c = slope(k + 0.5, z + 0.5 * ds * b);
    const double d = slope(k + 1, z + ds * c);
    z += ds / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return way > kSurelySliding * to ? std::min(z, to) : z;
}

}  // namespace buckens::loads
