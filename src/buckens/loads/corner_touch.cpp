// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/loads/polyhedron_touch.h"
#include "buckens/spatial/touch_features.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::MovingPoint;
using spatial::TouchPlace;
using spatial::TouchSurface;

namespace {

// Of the smaller body, up to which corners are looked for inside the other one.
constexpr double kDeepestCorner = 0.1;
// Of the smaller body, by which places that touch nothing have to be nearer than those that may.
constexpr double kBesideCorner = 3e-5;

/// The nearest of some corners over the faces of another body.
class CornerOnFaces final : public spatial::TouchFinder {
 public:
  CornerOnFaces(std::shared_ptr<const Polyhedron> faces, std::vector<Polyhedron::Corner> corners,
                double size, bool is_second)
      : faces_(std::move(faces)),
        corners_(std::move(corners)),
        tree_(boxes_of(corners_), std::vector<std::uint32_t>(corners_.size(), 1U)),
        deepest_(kDeepestCorner * size),
        beside_(kBesideCorner * size),
        is_second_(is_second) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const MarkerMotion& flat = is_second_ ? F : M;
    const MarkerMotion& sharp = is_second_ ? M : F;
    const Nearest found = memory_.at(RelativePose::of(flat, sharp),
                                     [this](const RelativePose& pose) { return nearest(pose); });
    set_place(found, flat, sharp, out);
    if (!is_second_) turn_round(out);
  }

 private:
  struct Nearest {
    std::size_t corner = 0;
    Polyhedron::Sight sight;
  };

  Nearest nearest(const RelativePose& pose) const {
    Nearest best;
    const auto see = [&](int k) {
      const Polyhedron::Corner& corner = corners_[static_cast<std::size_t>(k)];
      return faces_->see(pose.r + pose.R * corner.at, pose.R, corner, deepest_);
    };
    if (corners_.size() == 1) {
      best.sight = see(0);
      return best;
    }
    double least = HUGE_VAL;
    tree_.search(
        [&](const AlignedBox3d& box) {
          return distance_to_nearest(faces_->faces().tree(), faces_->face_boxes(),
                                     seen_from_first(pose, box), deepest_);
        },
        [&](double distance, std::uint32_t /*marks*/) {
          return distance < std::max(least, deepest_);
        },
        [&](int k) {
          const Polyhedron::Sight sight = see(k);
          const double order = sight.is_across ? sight.gap : sight.gap + beside_;
          if (!(order < least)) return;
          least = order;
          best = {static_cast<std::size_t>(k), sight};
        });
    return best;
  }

  void set_place(const Nearest& found, const MarkerMotion& flat, const MarkerMotion& sharp,
                 TouchPlace& out) const {
    const MovingPoint corner = MovingPoint::of(sharp, corners_[found.corner].at);
    const Vector3d x = flat.R.transpose() * (corner.x - flat.p);
    const TouchSurface::View view = view_of(found.sight, x);
    const Vector3d rate =
        flat.R.transpose() * (corner.rate - flat.v - flat.w.cross(corner.x - flat.p));
    out.touches = found.sight.is_across;
    out.gap = view.distance;
    out.normal = flat.R * view.normal;
    out.normal_rate = flat.w.cross(out.normal) + flat.R * (view.curvature * rate);
    out.place = corner.x;
    out.place_rate = corner.rate;
  }

  TouchSurface::View view_of(const Polyhedron::Sight& sight, const Vector3d& x) const {
    if (!sight.is_across) return faces_->beside(sight.facet, x);
    TouchSurface::View out;
    const auto& corner = faces_->faces().corners(static_cast<std::size_t>(sight.facet));
    out.normal = faces_->normal(sight.facet);
    out.distance = out.normal.dot(x - corner[0]);
    return out;
  }

  std::shared_ptr<const Polyhedron> faces_;
  std::vector<Polyhedron::Corner> corners_;
  BoxTree tree_;
  double deepest_, beside_;
  bool is_second_;
  mutable PoseMemory<Nearest> memory_;
};

}  // namespace

std::vector<AlignedBox3d> boxes_of(const std::vector<Polyhedron::Corner>& corners) {
  std::vector<AlignedBox3d> out;
  for (const Polyhedron::Corner& corner : corners) out.emplace_back(corner.at, corner.at);
  return out;
}

TouchFinders corners_on_faces(const std::shared_ptr<const Polyhedron>& faces,
                              const std::vector<Polyhedron::Corner>& corners, double size,
                              bool is_second) {
  std::vector<Vector3d> points;
  for (const Polyhedron::Corner& corner : corners) points.push_back(corner.at);
  const std::size_t most = points.size() > kMostSingleCorners ? kCornerGroups : points.size();
  const double smaller = std::min(faces->size(), size);
  TouchFinders out;
  for (const std::vector<int>& group : far_groups(points, most)) {
    std::vector<Polyhedron::Corner> own;
    for (const int k : group) own.push_back(corners[static_cast<std::size_t>(k)]);
    out.push_back(std::make_shared<CornerOnFaces>(faces, std::move(own), smaller, is_second));
  }
  return out;
}

}  // namespace buckens::loads
