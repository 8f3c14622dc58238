// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/line_spots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/loads/shape_distance.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;

namespace {

// Both ends, the borders of at most six regions of a box, and where the overlap begins and ends.
constexpr std::size_t kMostStations = 10;
// A spot with less than this share of the force has none: rounding must not close it.
constexpr double kNoShare = 1e-9;
// Stiffness of two round axes: crossed, they touch in a point, which has K as of spheres.
constexpr double kOfCrossed = 35.0 / 48.0;
// Halvings that leave nothing of an interval.
constexpr int kLineHalvings = 200;
// Gauss's points on −1 … 1: within a region the overlap is smooth over lengths of the radius.
constexpr std::array<double, 4> kLinePoint = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kLineWeight = {0.3626837833783620, 0.3137066458778873,
                                               0.2223810344533745, 0.1012285362903763};

/// The axis of a capsule in axes of a convex solid: along it the distance is convex.
struct Line {
  const ContactShape& solid;
  Vector3d middle, along;
  double half;

  Vector3d at(double s) const { return middle + s * along; }
  double distance(double s, Vector3d& normal) const { return distance_from(solid, at(s), normal); }
  double distance(double s) const {
    Vector3d normal;
    return distance(s, normal);
  }
  double slope(double s) const {
    Vector3d normal;
    distance(s, normal);
    return normal.dot(along);
  }
};

/// Places along the line, ascending.
struct Stations {
  std::array<double, kMostStations> at;
  std::size_t count = 0;

  void add(double s, double half) {
    if (std::abs(s) < half) at[count++] = s;
  }
};

/// Where the line passes from one region of the solid's surroundings into another.
Stations borders(const Line& line) {
  Stations out;
  const auto add_slab = [&](double middle, double along, double half) {
    if (along == 0.0) return;
    out.add((half - middle) / along, line.half);
    out.add((-half - middle) / along, line.half);
  };
  if (line.solid.kind == ShapeKind::box) {
    for (int k = 0; k < 3; ++k) {
      if (k != line.solid.flat) add_slab(line.middle[k], line.along[k], line.solid.half[k]);
    }
  } else {
    const Vector3d& axis = line.solid.axis;
    add_slab(axis.dot(line.middle), axis.dot(line.along), line.solid.half_length);
    if (line.solid.kind == ShapeKind::cylinder) {  // and through its side
      const Vector3d m = line.middle - axis * axis.dot(line.middle);
      const Vector3d a = line.along - axis * axis.dot(line.along);
      const double aa = a.squaredNorm(), am = a.dot(m);
      const double radius = line.solid.radius;
      const double square = am * am - aa * (m.squaredNorm() - radius * radius);
      if (aa > 0.0 && square > 0.0) {
        out.add((-am + std::sqrt(square)) / aa, line.half);
        out.add((-am - std::sqrt(square)) / aa, line.half);
      }
    }
  }
  std::sort(out.at.begin(), out.at.begin() + static_cast<std::ptrdiff_t>(out.count));
  return out;
}

/// Where a falling or rising function along the line changes sign, by halving.
template <class F>
double change_of_sign(double low, double high, F&& is_low) {
  for (int k = 0; k < kLineHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (is_low(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double nearest(const Line& line) {
  if (line.slope(-line.half) >= 0.0) return -line.half;
  if (line.slope(line.half) <= 0.0) return line.half;
  return change_of_sign(-line.half, line.half, [&](double s) { return line.slope(s) < 0.0; });
}

/// What the overlap along the line exerts.
struct LineForce {
  double energy = 0;                   // per stiffness [m²]
  Vector3d sum = Vector3d::Zero();     // force per stiffness [m]
  Vector3d moment = Vector3d::Zero();  // ∫ s df
};

/// @param low,high where the overlap begins and ends
LineForce force_along(const Line& line, double radius, double low, double high) {
  Stations all = borders(line);
  const auto first = all.at.begin();
  auto last = std::remove_if(first, first + static_cast<std::ptrdiff_t>(all.count),
                             [&](double s) { return s <= low || s >= high; });
  *last++ = high;
  double cube = 0.0, length = 0.0;
  Vector3d square_sum = Vector3d::Zero(), square_moment = Vector3d::Zero();
  Vector3d plain_sum = Vector3d::Zero(), plain_moment = Vector3d::Zero();
  double begin = low;
  for (auto end = first; end != last; begin = *end++) {
    const double middle = 0.5 * (begin + *end), half = 0.5 * (*end - begin);
    for (std::size_t k = 0; k < kLinePoint.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        const double s = middle + side * half * kLinePoint[k];
        Vector3d normal;
        const double overlap = std::max(0.0, radius - line.distance(s, normal));
        const double weight = half * kLineWeight[k];
        cube += weight * overlap * overlap * overlap;
        length += weight * overlap;
        square_sum += weight * overlap * overlap * normal;
        square_moment += weight * overlap * overlap * s * normal;
        plain_sum += weight * normal;
        plain_moment += weight * s * normal;
      }
    }
  }
  LineForce out;
  if (!(length > 0.0)) return out;
  out.energy = cube / length;
  out.sum = (3.0 * square_sum - out.energy * plain_sum) / length;
  out.moment = (3.0 * square_moment - out.energy * plain_moment) / length;
  return out;
}

/// A spot that exerts nothing.
ContactSpot open_spot(const Line& line, double radius, double s) {
  ContactSpot out;
  const double away = line.distance(s, out.normal);
  out.gap = std::max(0.0, away - radius);
  out.place = line.at(s) - 0.5 * (away + radius) * out.normal;
  return out;
}

}  // namespace

void find_line_spots(const ContactShape& first, const ContactShape& capsule, const Vector3d& r,
                     const Matrix3d& R, std::span<ContactSpot, 2> spots) {
  const Line line{first, r, R * capsule.axis, capsule.half_length};
  const double radius = capsule.radius, half = line.half;
  const double best = nearest(line);
  if (!(line.distance(best) < radius)) {
    const bool is_between = std::abs(best) < half;
    spots[0] = open_spot(line, radius, is_between ? best : -half);
    spots[1] = open_spot(line, radius, is_between ? best : half);
    return;
  }
  const auto overlaps = [&](double s) { return line.distance(s) < radius; };
  const double low =
      overlaps(-half) ? -half : change_of_sign(-half, best, [&](double s) { return !overlaps(s); });
  const double high = overlaps(half) ? half : change_of_sign(best, half, overlaps);
  const LineForce force = force_along(line, radius, low, high);
  const double span = high - low;
  if (!(span > 0.0) || !(force.energy > 0.0)) {
    spots[0] = open_spot(line, radius, -half);
    spots[1] = open_spot(line, radius, half);
    return;
  }
  const std::array<Vector3d, 2> shares = {Vector3d((high * force.sum - force.moment) / span),
                                          Vector3d((force.moment - low * force.sum) / span)};
  // Overlaps in proportion to the forces, so that both springs have the energy of the line.
  const double stiffness = first.kind == ShapeKind::capsule ? kOfCrossed : 1.0;
  const double scale = 2.0 * force.energy / (shares[0].squaredNorm() + shares[1].squaredNorm());
  for (std::size_t k = 0; k < 2; ++k) {
    const double size = shares[k].norm();
    if (size <= kNoShare * force.sum.norm()) {
      spots[k] = open_spot(line, radius, k == 0 ? -half : half);
      continue;
    }
    ContactSpot& spot = spots[k];
    spot = {};
    const double s = k == 0 ? low : high;
    spot.normal = shares[k] / size;
    spot.gap = -scale * size;
    spot.share = stiffness / scale;
    spot.place = line.at(s) - 0.5 * (line.distance(s) + radius) * spot.normal;
  }
}

}  // namespace buckens::loads
