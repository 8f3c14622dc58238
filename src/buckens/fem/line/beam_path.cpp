// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/beam_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/quadrature.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using PathPoints = std::vector<Vector3d>;

// Sine of the angle at the middle point below which three points lie on one line.
constexpr double kSineOnLine = 1e-6;

PathPoints arc_points(const PathPoints& points, int pieces) {
  if (points.size() != 3) {
    throw ModelError(fmt::format(
        "an arc goes through one point between its ends; {} are given. Choose a polyline or a "
        "spline, or divide it into several beams",
        points.size() - 2));
  }
  const Vector3d a = points[1] - points[0], b = points[2] - points[0];
  const Vector3d normal = a.cross(b);
  if (normal.norm() <= kSineOnLine * a.norm() * (points[2] - points[1]).norm()) {
    throw ModelError(fmt::format(
        "the points of the arc lie on one line; move the one between, ({:g}, {:g}, {:g}) m, off it",
        points[1].x(), points[1].y(), points[1].z()));
  }
  const Vector3d to_centre =
      (b.squaredNorm() * normal.cross(a) - a.squaredNorm() * normal.cross(b)) /
      (2.0 * normal.squaredNorm());
  const Vector3d centre = points[0] + to_centre;
  const Vector3d x = -to_centre, y = normal.normalized().cross(x);
  const Vector3d last = points[2] - centre;
  double angle = std::atan2(last.dot(y), last.dot(x));
  if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
  PathPoints out = {points.front()};
  for (int k = 1; k < pieces; ++k) {
    const double at = angle * k / pieces;
    out.push_back(centre + std::cos(at) * x + std::sin(at) * y);
  }
  out.push_back(points.back());
  return out;
}

/// One stretch of a cubic curve: at t ∈ [0, 1] the point p0 + t (p1 − p0) + bending.
class CubicStretch {
 public:
  /// @param m0, m1 second derivatives by the parameter at the ends, zero for a straight line
  /// @param width of the parameter
  CubicStretch(const Vector3d& p0, const Vector3d& p1, const Vector3d& m0, const Vector3d& m1,
               double width)
      : p0_(p0), chord_(p1 - p0), m0_(width * width / 6.0 * m0), m1_(width * width / 6.0 * m1) {}

  Vector3d at(double t) const {
    const double s = 1.0 - t;
    return p0_ + t * chord_ + (s * s * s - s) * m0_ + (t * t * t - t) * m1_;
  }
  /// Length from the start to t.
  double length(double t) const {
    static const LineRule rule = gauss_jacobi(12, 0);
    double sum = 0.0;
    for (Eigen::Index g = 0; g < rule.place.size(); ++g) {
      const double u = 0.5 * t * (1.0 + rule.place[g]);
      sum += 0.5 * t * rule.weight[g] * speed(u);
    }
    return sum;
  }
  /// The place at a share of the length, by bisection.
  double place(double share) const {
    const double wanted = share * length(1.0);
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (length(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  double speed(double t) const {
    const double s = 1.0 - t;
    return (chord_ - (3.0 * s * s - 1.0) * m0_ + (3.0 * t * t - 1.0) * m1_).norm();
  }

  Vector3d p0_, chord_, m0_, m1_;
};

/// Second derivatives of the natural cubic spline at its points (Thomas's algorithm).
PathPoints spline_curvatures(const PathPoints& p, const std::vector<double>& width) {
  const std::size_t n = p.size();
  PathPoints m(n, Vector3d::Zero());
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vector3d right = 6.0 * ((p[i + 1] - p[i]) / width[i] - (p[i] - p[i - 1]) / width[i - 1]);
    const double pivot = 2.0 * (width[i - 1] + width[i]) - width[i - 1] * upper[i - 1];
    upper[i] = width[i] / pivot;
    m[i] = (right - width[i - 1] * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i > 0; --i) m[i] -= upper[i] * m[i + 1];
  return m;
}

/// Numbers of pieces by length, at least one each: always one more where pieces are longest.
std::vector<int> pieces_by_length(const std::vector<double>& lengths, int pieces) {
  std::vector<int> out(lengths.size(), 1);
  double sum = 0.0;
  for (const double length : lengths) sum += length;
  int given = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    out[k] = std::max(1, static_cast<int>(pieces * lengths[k] / sum));
    given += out[k];
  }
  const auto piece = [&](std::size_t k) { return lengths[k] / out[k]; };
  for (; given != pieces; given += given < pieces ? 1 : -1) {
    std::size_t chosen = lengths.size();
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      if (given > pieces && out[k] == 1) continue;
      const bool is_better =
          chosen == lengths.size() ||
          (given < pieces ? piece(k) > piece(chosen)
                          : lengths[k] / (out[k] - 1) < lengths[chosen] / (out[chosen] - 1));
      if (is_better) chosen = k;
    }
    out[chosen] += given < pieces ? 1 : -1;
  }
  return out;
}

}  // namespace

PathPoints divide_path(BeamPath path, const PathPoints& points, int pieces) {
  std::vector<double> width;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    width.push_back((points[k + 1] - points[k]).norm());
    if (width.back() > 1e-12 * (points[k].norm() + points[k + 1].norm())) continue;
    throw ModelError(fmt::format("two points in a row lie at ({:g}, {:g}, {:g}) m; remove one",
                                 points[k].x(), points[k].y(), points[k].z()));
  }
  if (path == BeamPath::arc) return arc_points(points, pieces);
  const int num_stretches = static_cast<int>(width.size());
  if (pieces < num_stretches) {
    throw ModelError(
        fmt::format("{} elements cannot go through {} points between the ends; give at least {}",
                    pieces, num_stretches - 1, num_stretches));
  }
  const PathPoints none(points.size(), Vector3d::Zero());
  const PathPoints bend = path == BeamPath::spline ? spline_curvatures(points, width) : none;
  std::vector<CubicStretch> stretches;
  std::vector<double> lengths;
  for (std::size_t k = 0; k < width.size(); ++k) {
    stretches.emplace_back(points[k], points[k + 1], bend[k], bend[k + 1], width[k]);
    lengths.push_back(stretches.back().length(1.0));
  }
  const std::vector<int> counts = pieces_by_length(lengths, pieces);
  PathPoints out = {points.front()};
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    for (int i = 1; i < counts[k]; ++i) {
      const double share = static_cast<double>(i) / counts[k];
      out.push_back(stretches[k].at(path == BeamPath::spline ? stretches[k].place(share) : share));
    }
    out.push_back(points[k + 1]);
  }
  return out;
}

}  // namespace buckens::fem
