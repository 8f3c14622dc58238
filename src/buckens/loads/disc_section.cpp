// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/disc_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace buckens::loads {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

// Places on the circle that are this close, as a share of the radius, are one.
constexpr double kOnCircle = 1e-9;

// Below this, x − sin x is summed as a series, whose next term is 1e-17 of it.
constexpr double kSmallArc = 0.3;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// x − sin x.
double arc_beyond_sine(double x) {
  if (x > kSmallArc) return x - std::sin(x);
  const double q = x * x;
  return x * q / 6.0 *
         (1.0 -
          q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0 * (1.0 - q / 156.0)))));
}

/// Adds triangles and segments of a circle.
struct SectionSum {
  double radius, value;
  Vector2d slope;
  SectionSums out;

  double depth_at(const Vector2d& x) const { return -(value + slope.dot(x)); }

  void add_triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const double area = 0.5 * cross(b - a, c - a);
    out.area += area;
    const Vector2d sum = a + b + c;
    out.first += area / 3.0 * sum;
    out.second +=
        area / 12.0 *
        (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    out.depth += area * depth_at(sum / 3.0);
  }

  /// Between an arc and its chord, from one point of the circle counter-clockwise to another.
  void add_segment(const Vector2d& from, const Vector2d& to) {
    double turn = std::atan2(cross(from, to), from.dot(to));
    if (turn < 0.0) turn += 2.0 * std::numbers::pi;
    const double half = 0.5 * turn;
    const double c = std::cos(half), s = std::sin(half), r = radius;
    const double beyond = 0.5 * arc_beyond_sine(turn);  // half − s c
    if (!(beyond > 0.0)) return;
    const Vector2d middle = Eigen::Rotation2D<double>(half) * from.normalized();
    const Vector2d across(-middle.y(), middle.x());
    const double area = r * r * beyond;
    const Vector2d centre = 2.0 / 3.0 * r * s * s * s / beyond * middle;
    const double cubes = s * s * s * c, fourth = 0.25 * r * r * r * r;
    out.area += area;
    out.first += area * centre;
    out.second += fourth * (beyond + 2.0 * cubes) * middle * middle.transpose() +
                  fourth * (beyond - 2.0 / 3.0 * cubes) * across * across.transpose();
    out.depth += area * depth_at(centre);
  }
};

}  // namespace

ConvexSection ConvexSection::rectangle(double half_x, double half_y) {
  ConvexSection out;
  out.corners[0] = {half_x, half_y};
  out.corners[1] = {-half_x, half_y};
  out.corners[2] = {-half_x, -half_y};
  out.corners[3] = {half_x, -half_y};
  out.count = 4;
  return out;
}

void ConvexSection::cut(double value, const Vector2d& slope) {
  ConvexSection out;
  const auto add = [&](const Vector2d& x) {
    if (out.count < kMostCorners) out.corners[out.count++] = x;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d& one = corners[k];
    const Vector2d& next = corners[k + 1 < count ? k + 1 : 0];
    const double a = value + slope.dot(one), b = value + slope.dot(next);
    if (a <= 0.0) add(one);
    if ((a <= 0.0) != (b <= 0.0)) add(one + a / (a - b) * (next - one));
  }
  *this = out;
}

double ConvexSection::distance() const {
  double square = HUGE_VAL;
  bool is_inside = true;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d& p = corners[k];
    const Vector2d d = corners[k + 1 < count ? k + 1 : 0] - p;
    is_inside = is_inside && cross(d, -p) >= 0.0;
    const double length = d.squaredNorm();
    const double t = length > 0.0 ? std::clamp(-d.dot(p) / length, 0.0, 1.0) : 0.0;
    square = std::min(square, (p + t * d).squaredNorm());
  }
  return is_inside ? 0.0 : std::sqrt(square);
}

SectionSums sums_within_disc(const ConvexSection& polygon, double radius, double value,
                             const Vector2d& slope) {
  // Pieces of its edges within the circle, in turn; between them arcs.
  struct Piece {
    Vector2d from, to;
    bool ends_outside;
  };
  std::array<Piece, ConvexSection::kMostCorners> pieces;
  std::size_t count = 0;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Vector2d& p = polygon.corners[k];
    const Vector2d& q = polygon.corners[k + 1 < polygon.count ? k + 1 : 0];
    const Vector2d d = q - p;
    const double dd = d.squaredNorm(), pd = p.dot(d);
    const double square = pd * pd - dd * (p.squaredNorm() - radius * radius);
    if (!(dd > 0.0) || !(square > 0.0)) continue;
    const double root = std::sqrt(square);
    const double begin = (-pd - root) / dd, end = (-pd + root) / dd;
    if (begin >= 1.0 || end <= 0.0) continue;
    pieces[count++] = {begin > 0.0 ? Vector2d(p + begin * d) : p,
                       end < 1.0 ? Vector2d(p + end * d) : q, end < 1.0};
  }
  SectionSum sum{radius, value, slope, {}};
  if (count == 0) {
    if (polygon.count < 3 || polygon.distance() > 0.0) return sum.out;
    const Vector2d right(radius, 0.0);
    sum.add_segment(right, -right);
    sum.add_segment(-right, right);
    return sum.out;
  }
  const Vector2d& base = pieces[0].from;
  for (std::size_t k = 0; k < count; ++k) {
    const Piece& one = pieces[k];
    const Piece& next = pieces[k + 1 < count ? k + 1 : 0];
    if (k > 0) sum.add_triangle(base, one.from, one.to);
    if (!one.ends_outside) continue;
    // A corner on the circle: between two pieces nothing is left of the arc, least of all all of
    // it.
    if (count > 1 && (next.from - one.to).norm() < kOnCircle * radius) continue;
    sum.add_triangle(base, one.to, next.from);
    sum.add_segment(one.to, next.from);
  }
  return sum.out;
}

}  // namespace buckens::loads
