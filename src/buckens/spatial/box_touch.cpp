// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/box_touch.h"

#include <array>
#include <cmath>

#include "buckens/spatial/box_separation.h"
#include "buckens/spatial/rigid_touch.h"
#include "buckens/spatial/touch_features.h"

namespace buckens::spatial {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Square of the sine between edges whose crossing has no place.
constexpr double kParallelLines = 1e-6;
// A quadrilateral that is cut by four sides.
constexpr std::size_t kMostCorners = 8;

/// A corner of the area in which two faces overlap, between two of its edges.
struct Corner {
  Vector2d at;
  int before, after;  // edges: 0 … 3 of the incident face, 4 … 7 sides of the reference face
};

/// The incident face as seen in the plane of the reference face, and what its sides leave of it.
struct Area {
  std::array<Corner, kMostCorners> corners;
  std::size_t count = 0;

  /// Keeps what lies inside a side of the reference face.
  void cut(int side, const Vector2d& outwards, double most) {
    Area out;
    for (std::size_t k = 0; k < count; ++k) {
      const Corner& one = corners[k];
      const Corner& next = corners[(k + 1) % count];
      const double a = most - outwards.dot(one.at), b = most - outwards.dot(next.at);
      if (a >= 0.0) out.add(one);
      if ((a >= 0.0) == (b >= 0.0)) continue;
      const Vector2d at = one.at + a / (a - b) * (next.at - one.at);
      // Where the boundary leaves, it goes on along the side; where it comes back, on its own edge.
      out.add(a >= 0.0 ? Corner{at, one.after, side} : Corner{at, side, one.after});
    }
    *this = out;
  }
  void add(const Corner& corner) {
    if (count < kMostCorners) corners[count++] = corner;
  }
  const Corner& furthest(const Vector2d& direction) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < count; ++k) {
      if (direction.dot(corners[k].at) > direction.dot(corners[best].at)) best = k;
    }
    return corners[best];
  }
};

/// A box with its motion.
struct Side {
  const TouchSurface* box;
  const MarkerMotion* motion;
  Vector3d axis(int k) const { return motion->R.col(k); }
};

/// A face, its two directions u and v, and the signs of its corners and edges in them.
struct Face {
  Side side;
  int axis = 0;
  double sign = 1.0;  // of the outward normal along the axis

  int u() const { return (axis + 1) % 3; }
  int v() const { return (axis + 2) % 3; }
  Vector3d normal() const { return sign * side.axis(axis); }
  Vector3d middle() const { return side.motion->p + side.box->half[axis] * normal(); }
  static constexpr std::array<double, 4> kU = {1, -1, -1, 1}, kV = {1, 1, -1, -1};
  Vector3d corner(int k) const {
    const auto c = static_cast<std::size_t>(k);
    return middle() + kU[c] * side.box->half[u()] * side.axis(u()) +
           kV[c] * side.box->half[v()] * side.axis(v());
  }
};

/// A point that moves with `owner` at a face of the other box.
/// @param sign 1: the face belongs to the first box
void set_point(const Face& face, const Vector3d& x, const MarkerMotion& owner, double sign,
               TouchPlace& out) {
  out.normal = sign * face.normal();
  out.normal_rate = face.side.motion->w.cross(out.normal);
  out.gap = face.normal().dot(x - face.middle());
  out.place = x;
  out.place_rate = owner.v + owner.w.cross(x - owner.p);
}

using Edge = MovingEdge;

/// Two faces that look at each other.
class FacePair {
 public:
  /// @param sign 1: the reference is the first box
  FacePair(const Face& reference, const Face& incident, double sign)
      : reference_(reference), incident_(incident), sign_(sign) {}

  void look(const Vector2d& direction, TouchPlace& out) const {
    const Area area = overlap();
    if (area.count == 0) return beside(out);
    const Corner& corner = area.furthest(direction);
    const bool on_incident = corner.after < 4, came_on_incident = corner.before < 4;
    if (on_incident && came_on_incident) {
      set_point(reference_, incident_.corner(corner.after), *incident_.side.motion, sign_, out);
    } else if (on_incident != came_on_incident) {
      cross(on_incident ? corner.after : corner.before, on_incident ? corner.before : corner.after,
            corner.at, out);
    } else {
      set_point(incident_, reference_.corner(corner_between(corner.before, corner.after)),
                *reference_.side.motion, -sign_, out);
    }
  }

 private:
  static constexpr std::array<double, 4> kOutU = {1, -1, 0, 0}, kOutV = {0, 0, 1, -1};

  Area overlap() const {
    Area out;
    for (int k = 0; k < 4; ++k) out.add({seen(incident_.corner(k)), (k + 3) % 4, k});
    const Vector3d& half = reference_.side.box->half;
    for (std::size_t k = 0; k < 4; ++k) {
      const double most = half[k < 2 ? reference_.u() : reference_.v()];
      out.cut(4 + static_cast<int>(k), {kOutU[k], kOutV[k]}, most);
    }
    return out;
  }
  Vector2d seen(const Vector3d& x) const {
    const Vector3d from = x - reference_.side.motion->p;
    return {reference_.side.axis(reference_.u()).dot(from),
            reference_.side.axis(reference_.v()).dot(from)};
  }
  static int corner_between(int one, int other) {
    const auto a = static_cast<std::size_t>(one - 4), b = static_cast<std::size_t>(other - 4);
    const double u = kOutU[a] + kOutU[b], v = kOutV[a] + kOutV[b];
    return u > 0.0 ? (v > 0.0 ? 0 : 3) : (v > 0.0 ? 1 : 2);
  }
  Edge incident_edge(int k) const {
    const Vector3d a = incident_.corner(k), b = incident_.corner((k + 1) % 4);
    return {incident_.side.motion, 0.5 * (a + b), 0.5 * (b - a)};
  }
  Edge reference_side(int side) const {
    const auto k = static_cast<std::size_t>(side - 4);
    const Vector3d& half = reference_.side.box->half;
    const int across = k < 2 ? reference_.u() : reference_.v();
    const int along = k < 2 ? reference_.v() : reference_.u();
    return {
        reference_.side.motion,
        reference_.middle() + (kOutU[k] + kOutV[k]) * half[across] * reference_.side.axis(across),
        half[along] * reference_.side.axis(along)};
  }
  void cross(int edge, int side, const Vector2d& at, TouchPlace& out) const {
    const Edge own = incident_edge(edge), other = reference_side(side);
    const double sine = own.half.cross(other.half).squaredNorm();
    if (sine > kParallelLines * own.half.squaredNorm() * other.half.squaredNorm()) {
      const bool is_first = sign_ > 0.0;
      return set_crossing(is_first ? other : own, is_first ? own : other,
                          sign_ * reference_.normal(), out);
    }
    // Side by side: a point of the edge, above where they cross.
    const Vector2d from = seen(own.middle - own.half), way = seen(own.middle + own.half) - from;
    const double share = way.dot(at - from) / way.squaredNorm();
    set_point(reference_, own.middle + (2.0 * share - 1.0) * own.half, *own.owner, sign_, out);
  }
  /// They do not overlap: the corner that is nearest.
  void beside(TouchPlace& out) const {
    out.gap = HUGE_VAL;
    for (int k = 0; k < 4; ++k) {
      const Vector3d x = incident_.corner(k);
      const MarkerMotion& R = *reference_.side.motion;
      const TouchSurface::View view = reference_.side.box->look(R.R.transpose() * (x - R.p));
      if (view.distance >= out.gap) continue;
      out.gap = view.distance;
      out.normal = sign_ * (R.R * view.normal);
      out.normal_rate = R.w.cross(out.normal);
      out.place = x;
      const MarkerMotion& owner = *incident_.side.motion;
      const Vector3d rate = owner.v + owner.w.cross(x - owner.p);
      const Vector3d own = R.R.transpose() * (rate - R.v - R.w.cross(x - R.p));
      out.normal_rate += sign_ * (R.R * (view.curvature * own));
      out.place_rate = rate;
    }
  }

  const Face &reference_, &incident_;
  double sign_;
};

Face face_towards(const Side& side, const Vector3d& direction) {
  Vector3d looks = side.motion->R.transpose() * direction;
  if (side.box->flat >= 0) looks[side.box->flat] = 0.0;
  Face out{side};
  looks.cwiseAbs().maxCoeff(&out.axis);
  out.sign = looks[out.axis] < 0.0 ? -1.0 : 1.0;
  return out;
}

/// The edge along an axis that lies furthest out.
Edge outer_edge(const Side& side, int axis, const Vector3d& outwards) {
  Edge out{side.motion, side.motion->p, side.box->half[axis] * side.axis(axis)};
  for (int k = 0; k < 3; ++k) {
    if (k == axis) continue;
    const double sign = side.axis(k).dot(outwards) < 0.0 ? -1.0 : 1.0;
    out.middle += sign * side.box->half[k] * side.axis(k);
  }
  return out;
}

/// In planar models: the ends of the line along which two edges overlap.
void look_at_lines(const Face& reference, const Face& incident, double sign, double towards,
                   TouchPlace& out) {
  const auto line = [](const Face& face) {
    return face.u() == face.side.box->flat ? face.v() : face.u();
  };
  const int own = line(reference), other = line(incident);
  const Vector3d t = towards * reference.side.axis(own);
  const Vector3d reach = incident.side.box->half[other] * incident.side.axis(other);
  const Vector3d end = incident.middle() + (t.dot(reach) < 0.0 ? -1.0 : 1.0) * reach;
  const double most = reference.side.box->half[own];
  if (t.dot(end - reference.middle()) <= most) {
    return set_point(reference, end, *incident.side.motion, sign, out);
  }
  set_point(incident, reference.middle() + most * t, *reference.side.motion, -sign, out);
}

}  // namespace

void look_at_boxes(const TouchSurface& first_box, const TouchSurface& second_box, int direction,
                   const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) {
  const BoxSeparation apart = BoxSeparation::of(first_box, F.R, second_box, M.R, M.p - F.p);
  const Side first{&first_box, &F}, second{&second_box, &M};
  if (apart.feature == BoxSeparation::Feature::edges) {
    return set_crossing(outer_edge(first, apart.axis, apart.normal),
                        outer_edge(second, apart.edge, -apart.normal), apart.normal, out);
  }
  const bool by_first = apart.feature == BoxSeparation::Feature::first_face;
  const double sign = by_first ? 1.0 : -1.0;
  const Vector3d outwards = sign * apart.normal;
  const Face reference = face_towards(by_first ? first : second, outwards);
  const Face incident = face_towards(by_first ? second : first, -outwards);
  if (first_box.flat >= 0) {
    return look_at_lines(reference, incident, sign, direction == 0 ? 1.0 : -1.0, out);
  }
  const double angle = (direction + 0.5) * 2.0 * M_PI / kBoxDirections;
  FacePair(reference, incident, sign).look({std::cos(angle), std::sin(angle)}, out);
}

}  // namespace buckens::spatial
