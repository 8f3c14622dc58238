// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/segment_pair.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Square of the sine between segments that count as parallel.
constexpr double kParallelSegments = 1e-12;

}  // namespace

NearestOfSegments NearestOfSegments::of(const Vector3d& r, const Vector3d& a, const Vector3d& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ar = a.dot(r), br = b.dot(r);
  const double det = aa * bb - ab * ab;
  NearestOfSegments out;
  const auto set_first = [&] {
    out.on_first = aa > 0.0 ? std::clamp((ab * out.on_second + ar) / aa, -1.0, 1.0) : 0.0;
  };
  const bool are_parallel = det <= kParallelSegments * aa * bb;
  if (are_parallel) {
    // Both ends of the first as parameters of the second: the overlap's middle, or the nearer end.
    const double low = (-br - std::abs(ab)) / bb, high = (-br + std::abs(ab)) / bb;
    out.on_second = 0.5 * (std::clamp(low, -1.0, 1.0) + std::clamp(high, -1.0, 1.0));
    set_first();
    out.first_is_free = aa > 0.0 && std::abs(out.on_first) < 1.0;
    return out;
  }
  // Minimum of |r + t b − s a|, then clamped in turn, which is exact for two segments.
  out.on_first = std::clamp((bb * ar - ab * br) / det, -1.0, 1.0);
  out.on_second = std::clamp((ab * out.on_first - br) / bb, -1.0, 1.0);
  set_first();
  out.on_second = std::clamp((ab * out.on_first - br) / bb, -1.0, 1.0);
  out.first_is_free = aa > 0.0 && std::abs(out.on_first) < 1.0;
  out.second_is_free = std::abs(out.on_second) < 1.0;
  return out;
}

NearestOfSegments NearestOfSegments::of_lines(const Vector3d& r, const Vector3d& a,
                                              const Vector3d& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ar = a.dot(r), br = b.dot(r);
  const double det = aa * bb - ab * ab;
  return {(bb * ar - ab * br) / det, (ab * ar - aa * br) / det, true, true};
}

Vector2d NearestOfSegments::rates(const Vector3d& r, const Vector3d& a, const Vector3d& b,
                                  const Vector3d& r_rate, const Vector3d& a_rate,
                                  const Vector3d& b_rate) const {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const Vector3d f = r + on_second * b - on_first * a;
  const Vector3d f_rate = r_rate + on_second * b_rate - on_first * a_rate;
  // Where a parameter is free, its segment stays at right angles to f.
  const double first = a_rate.dot(f) + a.dot(f_rate);
  const double second = -(b_rate.dot(f) + b.dot(f_rate));
  if (first_is_free && second_is_free) {
    const double det = aa * bb - ab * ab;
    return {(bb * first + ab * second) / det, (ab * first + aa * second) / det};
  }
  if (first_is_free) return {first / aa, 0.0};
  if (second_is_free) return {0.0, second / bb};
  return Vector2d::Zero();
}

}  // namespace buckens::spatial
