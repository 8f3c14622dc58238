// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/loads/cylinder_over_mesh.h"
#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/spatial/touch_features.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::MovingPoint;
using spatial::TouchPlace;
using spatial::TouchSurface;

namespace {

// Of the smaller body, up to which corners are looked for inside a cylinder.
constexpr double kDeepestInCylinder = 0.1;
// Of the smaller body, by which places that touch nothing have to be nearer than those that may.
constexpr double kBesideCylinder = 1e-2;
// Sine by which an edge may dip below the end or side that it is told to touch: as of polyhedra.
constexpr double kDipBelow = 0.1;

/// The nearest of some corners of F to a cylinder of M.
class CornersAtCylinder final : public spatial::TouchFinder {
 public:
  /// @param size of the smaller body, @param same below which lengths are the same [m]
  CornersAtCylinder(std::vector<Polyhedron::Corner> corners, const TouchSurface& cylinder,
                    double size, double same)
      : corners_(std::move(corners)),
        tree_(boxes_of(corners_), std::vector<std::uint32_t>(corners_.size(), 1U)),
        cylinder_(cylinder),
        deepest_(kDeepestInCylinder * size),
        beside_(kBesideCylinder * size),
        same_(same) {
    for (const double end : {1.0, -1.0}) {
      around_.extend(box_around_disc(end * cylinder.half_length * cylinder.axis, cylinder.axis,
                                     cylinder.radius));
    }
  }

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const Found found = memory_.at(RelativePose::of(M, F),
                                   [this](const RelativePose& pose) { return nearest(pose); });
    const MovingPoint corner = MovingPoint::of(F, corners_[found.corner].at);
    const Vector3d x = M.R.transpose() * (corner.x - M.p);
    out.touches = found.part == Part::end || found.part == Part::side;
    spatial::set_sphere_at(view(found.part, x), M, corner, 0.0, out);
    out.place = corner.x;
    out.place_rate = corner.rate;
    spatial::turn_round(out);
  }

 private:
  /// What a corner touches, or is next to: the rim, or whatever is nearest if it came in elsewhere.
  enum class Part { end, side, rim, elsewhere };
  struct Found {
    std::size_t corner = 0;
    Part part = Part::elsewhere;
    double order = HUGE_VAL;
  };

  /// @param x in axes of the cylinder
  TouchSurface::View view(Part part, const Vector3d& x) const {
    const double along = cylinder_.axis.dot(x);
    TouchSurface::View out;
    if (part == Part::end) {
      out.normal = along < 0.0 ? Vector3d(-cylinder_.axis) : cylinder_.axis;
      out.distance = std::abs(along) - cylinder_.half_length;
      return out;
    }
    if (part == Part::rim) return cylinder_.look(x);
    if (part == Part::elsewhere) {
      out = cylinder_.look(x);
      // It touches nothing, so it is apart.
      if (out.distance > 0.0) return out;
      out.distance = deepest_ - out.distance;
      out.normal = -out.normal;
      return out;
    }
    const Vector3d away = x - along * cylinder_.axis;
    const double distance = away.norm();
    out.normal = distance > 0.0 ? Vector3d(away / distance) : cylinder_.axis.unitOrthogonal();
    out.distance = distance - cylinder_.radius;
    if (distance > 0.0) {
      out.curvature = (Matrix3d::Identity() - out.normal * out.normal.transpose() -
                       cylinder_.axis * cylinder_.axis.transpose()) /
                      distance;
    }
    return out;
  }

  /// @param pose of the mesh in axes of the cylinder
  Found nearest(const RelativePose& pose) const {
    Found best;
    tree_.search(
        [&](const AlignedBox3d& box) {
          return std::sqrt(around_.squaredExteriorDistance(seen_from_first(pose, box)));
        },
        [&](double distance, std::uint32_t /*marks*/) {
          return distance < std::max(best.order, deepest_);
        },
        [&](int k) {
          const auto corner = static_cast<std::size_t>(k);
          const Found found = see(corner, pose);
          if (found.order < best.order) best = found;
        });
    return best;
  }

  Found see(std::size_t k, const RelativePose& pose) const {
    const Polyhedron::Corner& corner = corners_[k];
    const Vector3d x = pose.r + pose.R * corner.at;
    const TouchSurface::View end = view(Part::end, x), side = view(Part::side, x);
    if (end.distance > same_ && side.distance > same_) {
      return {k, Part::rim, std::hypot(end.distance, side.distance) + beside_};
    }
    if (end.distance > same_) return {k, Part::end, end.distance};
    if (side.distance > same_) return {k, Part::side, side.distance};
    Found out{k, Part::elsewhere, HUGE_VAL};
    double depth = deepest_;
    for (const Part part : {Part::end, Part::side}) {
      const TouchSurface::View& seen = part == Part::end ? end : side;
      const bool dips = std::any_of(
          corner.along.begin(), corner.along.end(),
          [&](const Vector3d& way) { return (pose.R * way).dot(seen.normal) < -kDipBelow; });
      if (dips || !(std::abs(seen.distance) < depth)) continue;
      depth = std::abs(seen.distance);
      out.part = part;
      out.order = seen.distance;
    }
    if (out.part == Part::elsewhere) out.order = deepest_;
    return out;
  }

  std::vector<Polyhedron::Corner> corners_;
  BoxTree tree_;
  TouchSurface cylinder_;
  AlignedBox3d around_;
  double deepest_, beside_, same_;
  mutable PoseMemory<Found> memory_;
};

}  // namespace

spatial::TouchFinders corners_at_cylinder(const std::shared_ptr<const Polyhedron>& mesh,
                                          const TouchSurface& cylinder) {
  const std::vector<Polyhedron::Corner>& all = mesh->corners();
  std::vector<Vector3d> points;
  for (const Polyhedron::Corner& corner : all) points.push_back(corner.at);
  const std::size_t most = all.size() > kMostSingleCorners ? kCornerGroups : all.size();
  const double size = std::min(mesh->size(), greatest_length(cylinder));
  spatial::TouchFinders out;
  for (const std::vector<int>& group : far_groups(points, most)) {
    std::vector<Polyhedron::Corner> own;
    for (const int k : group) own.push_back(all[static_cast<std::size_t>(k)]);
    out.push_back(
        std::make_shared<CornersAtCylinder>(std::move(own), cylinder, size, mesh->same()));
  }
  return out;
}

}  // namespace buckens::loads
