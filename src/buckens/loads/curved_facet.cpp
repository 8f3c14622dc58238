// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/curved_facet.h"

#include <algorithm>
#include <cmath>

namespace buckens::loads {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kMostNewtonSteps = 12;
// Of the parameters, which are of the order of one.
constexpr double kFound = 1e-15;
// A point of an edge this near to its end, as a share of its length, is the corner.
constexpr double kAtCorner = 1e-12;

/// Place and derivatives at λ₁ = u, λ₂ = v.
struct At {
  Vector3d x, u, v, uu, vv, uv;
};

At evaluate(const CurvedFacet& f, const Vector2d& p) {
  const double u = p.x(), v = p.y(), w = 1.0 - u - v;
  const Vector3d &c0 = f.bulge[0], &c1 = f.bulge[1], &c2 = f.bulge[2];
  const Vector3d a = f.corner[1] - f.corner[0], b = f.corner[2] - f.corner[0];
  At out;
  out.x = f.corner[0] + u * a + v * b - (w * u) * c0 - (u * v) * c1 - (v * w) * c2;
  out.u = a - (w - u) * c0 - v * c1 + v * c2;
  out.v = b + u * c0 - u * c1 - (w - v) * c2;
  out.uu = 2.0 * c0;
  out.vv = 2.0 * c2;
  out.uv = c0 - c1 + c2;
  return out;
}

/// Parameters of the foot of the perpendicular onto the flat triangle, beyond its edges, too.
Vector2d flat_foot(const CurvedFacet& f, const Vector3d& point) {
  const Vector3d a = f.corner[1] - f.corner[0], b = f.corner[2] - f.corner[0];
  const Vector3d r = point - f.corner[0];
  Matrix2d G;
  G << a.squaredNorm(), a.dot(b), a.dot(b), b.squaredNorm();
  return G.inverse() * Vector2d(a.dot(r), b.dot(r));
}

bool is_within(const Vector2d& p) { return p.x() >= 0.0 && p.y() >= 0.0 && p.x() + p.y() <= 1.0; }

/// Foot of the perpendicular onto the curved surface; false if there is none within the facet.
bool foot_within(const CurvedFacet& f, const Vector3d& point, Vector2d& p) {
  p = flat_foot(f, point);
  if (f.is_flat()) return is_within(p);
  for (int k = 0; k < kMostNewtonSteps; ++k) {
    const At at = evaluate(f, p);
    const Vector3d r = at.x - point;
    const Vector2d g(r.dot(at.u), r.dot(at.v));
    Matrix2d H;
    H << at.u.dot(at.u) + r.dot(at.uu), at.u.dot(at.v) + r.dot(at.uv), 0.0,
        at.v.dot(at.v) + r.dot(at.vv);
    H(1, 0) = H(0, 1);
    // Beyond the centre of curvature the foot is a maximum: go on as if the surface were flat.
    if (!(H.determinant() > 0.0) || !(H(0, 0) > 0.0)) {
      H << at.u.dot(at.u), at.u.dot(at.v), at.u.dot(at.v), at.v.dot(at.v);
    }
    const Vector2d step = H.inverse() * g;
    p -= step;
    if (!(step.lpNorm<Eigen::Infinity>() > kFound)) break;
    // Far outside the patch means nothing.
    if (p.lpNorm<Eigen::Infinity>() > 4.0) return false;
  }
  return p.allFinite() && is_within(p);
}

/// Parameter of the nearest point of an edge, 0 … 1.
double nearest_on_edge(const Vector3d& a, const Vector3d& d, const Vector3d& c,
                       const Vector3d& point) {
  double t = std::clamp(d.dot(point - a) / d.squaredNorm(), 0.0, 1.0);
  if (c.isZero(0.0)) return t;
  for (int k = 0; k < kMostNewtonSteps; ++k) {
    const Vector3d r = a + t * d - (t * (1.0 - t)) * c - point;
    const Vector3d along = d - (1.0 - 2.0 * t) * c;
    double slope = along.squaredNorm() + 2.0 * r.dot(c);
    if (!(slope > 0.0)) slope = along.squaredNorm();
    const double next = std::clamp(t - r.dot(along) / slope, 0.0, 1.0);
    const bool is_found = std::abs(next - t) <= kFound;
    t = next;
    if (is_found) break;
  }
  return t;
}

}  // namespace

Vector3d CurvedFacet::bulge_between(const Vector3d& a, const Vector3d& normal_a, const Vector3d& b,
                                    const Vector3d& normal_b) {
  const Vector3d d = b - a;
  // The mean of what either end asks for: of an edge that bends both ways, nothing remains.
  const double rise = 0.5 * (normal_a.dot(d) - normal_b.dot(d));
  return rise / (1.0 + normal_a.dot(normal_b)) * (normal_a + normal_b);
}

bool CurvedFacet::is_flat() const {
  return bulge[0].isZero(0.0) && bulge[1].isZero(0.0) && bulge[2].isZero(0.0);
}

std::array<Vector3d, 6> CurvedFacet::hull() const {
  std::array<Vector3d, 6> out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = corner[k];
    out[3 + k] = 0.5 * (corner[k] + corner[(k + 1) % 3] - bulge[k]);
  }
  return out;
}

Vector3d CurvedFacet::at(const Vector3d& lambda) const {
  return evaluate(*this, Vector2d(lambda.y(), lambda.z())).x;
}

CurvedFacet::Place CurvedFacet::nearest(const Vector3d& point) const {
  Place out;
  Vector2d inside;
  if (foot_within(*this, point, inside)) {
    const At at = evaluate(*this, inside);
    out.at = at.x;
    out.normal = at.u.cross(at.v);
    out.square = (point - at.x).squaredNorm();
    out.parameters = inside;
    return out;
  }
  out.square = HUGE_VAL;
  static constexpr std::array<std::array<double, 2>, 3> kEnds = {{{0, 0}, {1, 0}, {0, 1}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Vector3d d = corner[next] - corner[k];
    const double t = nearest_on_edge(corner[k], d, bulge[k], point);
    const Vector3d at = corner[k] + t * d - (t * (1.0 - t)) * bulge[k];
    const double square = (point - at).squaredNorm();
    if (!(square < out.square)) continue;
    out.square = square;
    out.at = at;
    out.feature = static_cast<int>(t <= kAtCorner ? 3 + k : t >= 1.0 - kAtCorner ? 3 + next : k);
    const Vector2d p((1.0 - t) * kEnds[k][0] + t * kEnds[next][0],
                     (1.0 - t) * kEnds[k][1] + t * kEnds[next][1]);
    const At there = evaluate(*this, p);
    out.normal = there.u.cross(there.v);
    out.parameters = p;
  }
  return out;
}

Matrix3d CurvedFacet::curvature(const Vector3d& point, const Place& place) const {
  const double distance = std::sqrt(place.square);
  const Vector3d n = (point - place.at) / distance;
  Matrix3d out = Matrix3d::Identity() - n * n.transpose();
  // Less what the nearest place follows the point by.
  const At at = evaluate(*this, place.parameters);
  const Vector3d r = place.at - point;
  if (place.feature < 0) {
    Matrix2d H;
    H << at.u.dot(at.u) + r.dot(at.uu), at.u.dot(at.v) + r.dot(at.uv), 0.0,
        at.v.dot(at.v) + r.dot(at.vv);
    H(1, 0) = H(0, 1);
    Eigen::Matrix<double, 3, 2> X;
    X << at.u, at.v;
    out -= X * H.inverse() * X.transpose();
  } else if (place.feature < 3) {
    const auto k = static_cast<std::size_t>(place.feature);
    // λ along the edges: u, v − u, −v.
    const Vector3d along = k == 0 ? at.u : k == 1 ? Vector3d(at.v - at.u) : Vector3d(-at.v);
    out -= along * along.transpose() / (along.squaredNorm() + 2.0 * r.dot(bulge[k]));
  }
  return out / distance;
}

}  // namespace buckens::loads
