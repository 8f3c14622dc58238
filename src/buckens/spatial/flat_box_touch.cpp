// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/flat_box_touch.h"

#include "buckens/spatial/box_separation.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

/// A box with its motion.
struct Side {
  const TouchSurface* box;
  const MarkerMotion* motion;
  Vector3d axis(int k) const { return motion->R.col(k); }
};

/// A face of a flat box, seen from the side a line.
struct Face {
  Side side;
  int axis = 0;
  double sign = 1.0;  // of the outward normal along the axis

  /// Axis along the line.
  int line() const {
    const int next = (axis + 1) % 3;
    return next == side.box->flat ? (axis + 2) % 3 : next;
  }
  Vector3d normal() const { return sign * side.axis(axis); }
  Vector3d middle() const { return side.motion->p + side.box->half[axis] * normal(); }
  Vector3d half_line() const { return side.box->half[line()] * side.axis(line()); }
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

Face face_towards(const Side& side, const Vector3d& direction) {
  Vector3d looks = side.motion->R.transpose() * direction;
  looks[side.box->flat] = 0.0;
  Face out{side};
  looks.cwiseAbs().maxCoeff(&out.axis);
  out.sign = looks[out.axis] < 0.0 ? -1.0 : 1.0;
  return out;
}

}  // namespace

void look_at_flat_boxes(const TouchSurface& first_box, const TouchSurface& second_box,
                        int direction, const MarkerMotion& F, const MarkerMotion& M,
                        TouchPlace& out) {
  const BoxSeparation apart = BoxSeparation::of(first_box, F.R, second_box, M.R, M.p - F.p);
  const Side first{&first_box, &F}, second{&second_box, &M};
  const bool by_first = apart.feature == BoxSeparation::Feature::first_face;
  const double sign = by_first ? 1.0 : -1.0;
  const Vector3d outwards = sign * apart.normal;
  const Face reference = face_towards(by_first ? first : second, outwards);
  const Face incident = face_towards(by_first ? second : first, -outwards);

  const Vector3d along = (direction == 0 ? 1.0 : -1.0) * reference.side.axis(reference.line());
  const Vector3d reach = incident.half_line();
  const Vector3d end = incident.middle() + (along.dot(reach) < 0.0 ? -1.0 : 1.0) * reach;
  const double most = reference.side.box->half[reference.line()];
  if (along.dot(end - reference.middle()) <= most) {
    return set_point(reference, end, *incident.side.motion, sign, out);
  }
  set_point(incident, reference.middle() + most * along, *reference.side.motion, -sign, out);
}

}  // namespace buckens::spatial
