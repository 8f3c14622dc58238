// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/space_curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::joints {

using Eigen::Vector3d;

namespace {

// A natural spline forgets its end by 2 − √3 per point: after 30 of them nothing is left of it.
constexpr std::size_t kOverlap = 30;
constexpr int kSamplesPerPoint = 16;
constexpr int kMostIterations = 50;

/// Without the part along a unit vector; zero vector: all of it.
Vector3d flat(const Vector3d& v, const Vector3d& across) { return v - across.dot(v) * across; }

void require_points(const std::vector<Vector3d>& points, bool is_closed) {
  const std::size_t least = is_closed ? 3 : 2;
  if (points.size() < least) {
    throw ModelError(fmt::format("`path` has {} points; {} curve needs at least {}", points.size(),
                                 is_closed ? "a closed" : "a", least));
  }
  for (std::size_t i = 0; i + 1 < points.size() + (is_closed ? 1 : 0); ++i) {
    const std::size_t next = (i + 1) % points.size();
    if ((points[next] - points[i]).norm() > 0.0) continue;
    throw ModelError(
        fmt::format("points {} and {} of `path` are the same; remove one{}", i + 1, next + 1,
                    next == 0 ? " (`closed: on` goes back to the first point by itself)" : ""));
  }
}

}  // namespace

SpaceCurve::SpaceCurve(const std::vector<Vector3d>& points, bool is_closed)
    : is_closed_(is_closed) {
  require_points(points, is_closed);
  const std::size_t count = points.size();
  const auto point = [&](long i) {
    const auto n = static_cast<long>(count);
    return points[static_cast<std::size_t>(((i % n) + n) % n)];
  };
  const long before = is_closed ? static_cast<long>(kOverlap) : 0;
  const long last = static_cast<long>(count) + (is_closed ? before : -1);
  std::vector<double> s;
  std::array<std::vector<double>, 3> values;
  double first = 0.0;
  for (long i = -before; i <= last; ++i) {
    const double step = i == -before ? 0.0 : (point(i) - point(i - 1)).norm();
    s.push_back(s.empty() ? 0.0 : s.back() + step);
    if (i == 0) first = s.back();
    if (i == static_cast<long>(count) - (is_closed ? 0 : 1)) length_ = s.back() - first;
    for (int k = 0; k < 3; ++k) values[static_cast<std::size_t>(k)].push_back(point(i)[k]);
  }
  for (double& value : s) value -= first;
  knots_.assign(s.begin() + before,
                s.begin() + before + static_cast<long>(count) + (is_closed ? 1 : 0));
  for (std::size_t k = 0; k < 3; ++k) {
    laws_[k] =
        base::TimeLaw::table(s, values[k], base::Interpolation::spline, base::Extrapolation::hold);
  }
  sample(0.0, length_, kSamplesPerPoint * static_cast<int>(count));
}

SpaceCurve::SpaceCurve(const CurvePieces& pieces, bool is_closed)
    : pieces_(pieces), length_(pieces.length()), is_closed_(is_closed) {
  if (is_closed) pieces_.require_closed();
  for (const CurvePieces::Piece& piece : pieces_.all()) {
    if (knots_.empty()) knots_.push_back(piece.from);
    knots_.push_back(piece.to);
    const double turn = piece.radius > 0.0 ? (piece.to - piece.from) / piece.radius : 0.0;
    sample(piece.from, piece.to, kSamplesPerPoint * (1 + static_cast<int>(turn)));
  }
}

void SpaceCurve::sample(double from, double to, int count) {
  for (int k = 0; k <= count; ++k) {
    sampled_.push_back(from + (to - from) * k / count);
    places_.push_back(at(sampled_.back()).p);
  }
}

SpaceCurve::Point SpaceCurve::inside(double s) const {
  if (!pieces_.empty()) return pieces_.at(s);
  Point out;
  for (int k = 0; k < 3; ++k) {
    const base::TimeLaw& law = laws_[static_cast<std::size_t>(k)];
    out.p[k] = law.value(s);
    out.tangent[k] = law.rate(s);
    out.curvature[k] = law.acceleration(s);
  }
  return out;
}

SpaceCurve::Point SpaceCurve::at(double s) const {
  double inside = is_closed_ ? s - length_ * std::floor(s / length_) : std::clamp(s, 0.0, length_);
  // At the very end of a table that is held its rate is that beyond.
  if (!is_closed_) inside = std::min(inside, std::nextafter(length_, 0.0));
  Point out = this->inside(inside);
  if (!is_closed_ && s != inside && (s < 0.0 || s > length_)) {
    out.p += (s - inside) * out.tangent;
    out.curvature.setZero();
  }
  return out;
}

double SpaceCurve::nearest(const Vector3d& place, const Vector3d& across, double guess) const {
  double s = guess;
  for (int k = 0; k < kMostIterations; ++k) {
    const Point c = at(s);
    const Vector3d off = flat(place - c.p, across);
    const Vector3d tangent = flat(c.tangent, across);
    const double steep = tangent.squaredNorm();
    // Beyond its centre of curvature a curve has a farthest point; Newton would go there.
    const double slope = std::max(steep - off.dot(c.curvature), 0.1 * steep);
    const double change = std::clamp(off.dot(tangent) / slope, -0.1 * length_, 0.1 * length_);
    s += change;
    if (std::abs(change) <= 1e-15 * length_) break;
  }
  return s;
}

double SpaceCurve::nearest(const Vector3d& place, const Vector3d& across) const {
  double best = 0.0;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double distance = flat(place - places_[k], across).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = sampled_[k];
  }
  return nearest(place, across, best);
}

}  // namespace buckens::joints
