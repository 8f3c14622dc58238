// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/box_manifold.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/loads/shape_distance.h"
#include "buckens/loads/symmetric_root.h"
#include "buckens/spatial/box_separation.h"

namespace buckens::loads {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using spatial::BoxSeparation;

namespace {

// A quadrilateral that is cut by four sides and one plane.
constexpr std::size_t kMostCorners = 9;

/// A box in axes of the first one.
struct Placed {
  Vector3d middle;
  Matrix3d axes;
  Vector3d half;
  int flat;
};

/// Corners in the plane of the reference face with the overlap there.
struct Polygon {
  struct Corner {
    Vector2d at;
    double overlap;
  };
  std::array<Corner, kMostCorners> corners;
  std::size_t count = 0;

  void add(const Corner& corner) {
    if (count < kMostCorners) corners[count++] = corner;
  }
  /// Keeps what has inside(corner) ≥ 0.
  template <class F>
  void cut(F&& inside) {
    Polygon out;
    for (std::size_t k = 0; k < count; ++k) {
      const Corner& one = corners[k];
      const Corner& next = corners[(k + 1) % count];
      const double a = inside(one), b = inside(next);
      if (a >= 0.0) out.add(one);
      if ((a >= 0.0) == (b >= 0.0)) continue;
      const double share = a / (a - b);
      out.add({one.at + share * (next.at - one.at),
               one.overlap + share * (next.overlap - one.overlap)});
    }
    *this = out;
  }
};

/// Middle of the edge along an axis that lies furthest out.
Vector3d outer_edge(const Placed& box, int axis, const Vector3d& outwards) {
  Vector3d out = box.middle;
  for (int k = 0; k < 3; ++k) {
    if (k == axis) continue;
    out += (box.axes.col(k).dot(outwards) < 0.0 ? -box.half[k] : box.half[k]) * box.axes.col(k);
  }
  return out;
}

void set_edge_spot(const Placed& first, const Placed& second, const BoxSeparation& best,
                   std::span<ContactSpot, 4> spots) {
  const Vector3d p = outer_edge(first, best.axis, best.normal);
  const Vector3d q = outer_edge(second, best.edge, -best.normal);
  const Vector3d a = first.axes.col(best.axis), b = second.axes.col(best.edge);
  // Nearest points of both lines.
  const double ab = a.dot(b), ar = a.dot(q - p), br = b.dot(q - p);
  const double det = 1.0 - ab * ab;
  const Vector3d on_first = p + (ar - ab * br) / det * a;
  const Vector3d on_second = q + (ab * ar - br) / det * b;
  for (ContactSpot& spot : spots) {
    spot.place = 0.5 * (on_first + on_second);
    spot.normal = best.normal;
    spot.gap = std::max(0.0, best.gap);
    spot.share = 0.0;
  }
  spots[0].gap = best.gap;
  spots[0].share = 1.0;
}

/// The face of the incident box that looks at the reference face, as seen in its plane.
Polygon incident_face(const Placed& reference, const Placed& incident, const Vector3d& normal,
                      int axis) {
  int face = 0;
  Vector3d looks = incident.axes.transpose() * normal;
  if (incident.flat >= 0) looks[incident.flat] = 0.0;
  looks.cwiseAbs().maxCoeff(&face);
  const double side = looks[face] > 0.0 ? -1.0 : 1.0;
  const Vector3d u = reference.axes.col((axis + 1) % 3), v = reference.axes.col((axis + 2) % 3);
  const Vector3d e = incident.half[(face + 1) % 3] * incident.axes.col((face + 1) % 3);
  const Vector3d f = incident.half[(face + 2) % 3] * incident.axes.col((face + 2) % 3);
  const Vector3d middle = incident.middle + side * incident.half[face] * incident.axes.col(face);
  Polygon out;
  static constexpr double kE[] = {1, -1, -1, 1}, kF[] = {1, 1, -1, -1};
  for (int k = 0; k < 4; ++k) {
    const Vector3d at = middle + kE[k] * e + kF[k] * f - reference.middle;
    out.add({Vector2d(u.dot(at), v.dot(at)), reference.half[axis] - normal.dot(at)});
  }
  return out;
}

struct Moments {
  double area = 0;
  Vector2d centre = Vector2d::Zero();
  Matrix2d spread = Matrix2d::Zero();  // mean square about the centre
  double overlap = 0;                  // at the centre
};

Moments moments_of(const Polygon& polygon) {
  Moments out;
  if (polygon.count < 3) return out;
  const Polygon::Corner& base = polygon.corners[0];
  Vector2d first = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();
  double overlap = 0.0;
  for (std::size_t k = 1; k + 1 < polygon.count; ++k) {
    const Vector2d a = polygon.corners[k].at - base.at, b = polygon.corners[k + 1].at - base.at;
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    out.area += area;
    first += area / 3.0 * (a + b);
    // Of a triangle with a corner at the origin: A/12 (aaᵀ + bbᵀ + (a + b)(a + b)ᵀ).
    second += area / 12.0 * (a * a.transpose() + b * b.transpose() + (a + b) * (a + b).transpose());
    overlap +=
        area / 3.0 * (base.overlap + polygon.corners[k].overlap + polygon.corners[k + 1].overlap);
  }
  if (out.area == 0.0) return out;
  const Vector2d shift = first / out.area;
  out.spread = second / out.area - shift * shift.transpose();
  out.centre = base.at + shift;
  out.overlap = overlap / out.area;
  out.area = std::abs(out.area);
  return out;
}

/// Slope of the overlap over the plane, from a triangle of corners before they were cut.
Vector2d slope_of(const Polygon& face) {
  Matrix2d edges;
  edges.row(0) = (face.corners[1].at - face.corners[0].at).transpose();
  edges.row(1) = (face.corners[2].at - face.corners[1].at).transpose();
  const Vector2d rises(face.corners[1].overlap - face.corners[0].overlap,
                       face.corners[2].overlap - face.corners[1].overlap);
  return edges.inverse() * rises;
}

double face_area(const Placed& box, int axis) {
  return 4.0 * box.half[(axis + 1) % 3] * box.half[(axis + 2) % 3];
}

/// Mean over its faces: the measure must not jump from one face to another.
double mean_face(const Placed& box) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += k == box.flat ? 0.0 : face_area(box, k);
  return sum / (box.flat >= 0 ? 2.0 : 3.0);
}

/// @param sign 1: the reference is the first box
void set_face_spots(const Placed& reference, const Placed& incident, const BoxSeparation& best,
                    double sign, std::span<ContactSpot, 4> spots) {
  const int axis = best.axis;
  const Vector3d normal = sign * best.normal;  // out of the reference
  const Vector3d u = reference.axes.col((axis + 1) % 3), v = reference.axes.col((axis + 2) % 3);
  const double half_u = reference.half[(axis + 1) % 3], half_v = reference.half[(axis + 2) % 3];
  const Polygon face = incident_face(reference, incident, normal, axis);
  Polygon area = face;
  area.cut([&](const Polygon::Corner& c) { return half_u - c.at.x(); });
  area.cut([&](const Polygon::Corner& c) { return half_u + c.at.x(); });
  area.cut([&](const Polygon::Corner& c) { return half_v - c.at.y(); });
  area.cut([&](const Polygon::Corner& c) { return half_v + c.at.y(); });
  area.cut([&](const Polygon::Corner& c) { return c.overlap; });
  const Moments moments = moments_of(area);
  const bool touches = moments.area > 0.0 && moments.overlap > 0.0;
  const Vector2d slope = touches ? slope_of(face) : Vector2d(Vector2d::Zero());
  const Matrix2d root = touches ? symmetric_root(moments.spread) : Matrix2d(Matrix2d::Zero());
  const double share = moments.area / std::min(mean_face(reference), mean_face(incident));
  static constexpr double kU[] = {1, -1, -1, 1}, kV[] = {1, 1, -1, -1};
  for (std::size_t k = 0; k < 4; ++k) {
    ContactSpot& spot = spots[k];
    spot.normal = best.normal;
    const Vector2d out = root * Vector2d(kU[k], kV[k]);
    const Vector2d at = touches ? Vector2d(moments.centre + out) : Vector2d(Vector2d::Zero());
    const double overlap = touches ? moments.overlap + slope.dot(out) : -std::max(0.0, best.gap);
    spot.gap = -overlap;
    spot.share = touches ? share : 0.0;
    spot.place = reference.middle + at.x() * u + at.y() * v +
                 (reference.half[axis] - 0.5 * overlap) * normal;
  }
}

}  // namespace

void find_box_spots(const ContactShape& first, const ContactShape& second, const Vector3d& r,
                    const Matrix3d& R, std::span<ContactSpot, 4> spots) {
  Placed a{Vector3d::Zero(), Matrix3d::Identity(), first.half, first.flat};
  Placed b{r, R, second.half, second.flat};
  // Sections of planar models: any extent across the plane, the same for both.
  if (a.flat >= 0) a.half[a.flat] = 1.0;
  if (b.flat >= 0) b.half[b.flat] = 1.0;
  const BoxSeparation best =
      BoxSeparation::of(touch_surface(first), a.axes, touch_surface(second), b.axes, r);
  switch (best.feature) {
    case BoxSeparation::Feature::edges:
      return set_edge_spot(a, b, best, spots);
    case BoxSeparation::Feature::second_face:
      return set_face_spots(b, a, best, -1.0, spots);
    case BoxSeparation::Feature::first_face:
      return set_face_spots(a, b, best, 1.0, spots);
  }
}

}  // namespace buckens::loads
