// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/mesh_touch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "buckens/spatial/touch_features.h"

namespace buckens::loads {

using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::MovingPoint;
using spatial::TouchFinder;
using spatial::TouchPlace;
using spatial::TouchSurface;

namespace {

// Share of the size within which corners are at the same height.
constexpr double kSameHeight = 1e-9;

BoxTree tree_of(const std::vector<Vector3d>& points) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Vector3d& x : points) boxes.emplace_back(x, x);
  return BoxTree(boxes, std::vector<std::uint32_t>(points.size(), 1U));
}

/// The lowest of some corners over a plane.
class LowestCorner final : public TouchFinder {
 public:
  LowestCorner(const TouchSurface& plane, std::vector<Vector3d> corners, double size)
      : plane_(plane),
        corners_(std::move(corners)),
        tree_(tree_of(corners_)),
        same_(kSameHeight * size) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const int corner = corners_.size() == 1 ? 0 : lowest(M.R.transpose() * (F.R * plane_.axis));
    const Vector3d& at = corners_[static_cast<std::size_t>(corner)];
    set_sphere_at(plane_, F, MovingPoint::of(M, at), 0.0, out);
  }

 private:
  /// @param up height of x is up·x
  int lowest(const Vector3d& up) const {
    const Eigen::Array<bool, 3, 1> is_up = up.array() > 0.0;
    const auto height = [&](const Eigen::AlignedBox3d& box) {
      return up.dot(Vector3d(is_up.select(box.min(), box.max())));
    };
    const auto height_of = [&](int k) { return up.dot(corners_[static_cast<std::size_t>(k)]); };
    double least = HUGE_VAL;
    tree_.search(
        height, [&](double low, std::uint32_t /*marks*/) { return low < least; },
        [&](int k) { least = std::min(least, height_of(k)); });
    int first = static_cast<int>(corners_.size());
    tree_.search(
        height, [&](double low, std::uint32_t /*marks*/) { return low <= least + same_; },
        [&](int k) {
          if (k < first && height_of(k) <= least + same_) first = k;
        });
    return first;
  }

  TouchSurface plane_;
  std::vector<Vector3d> corners_;
  BoxTree tree_;
  double same_;
};

class SphereAtPatch final : public TouchFinder {
 public:
  SphereAtPatch(std::shared_ptr<const ContactMesh> mesh, int colour, double radius,
                const Vector3d& at)
      : mesh_(std::move(mesh)), colour_(colour), radius_(radius), at_(at) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const MovingPoint centre = MovingPoint::of(M, at_);
    const TouchSurface::View view = mesh_->look(F.R.transpose() * (centre.x - F.p), colour_);
    set_sphere_at(view, F, centre, radius_, out);
  }

 private:
  std::shared_ptr<const ContactMesh> mesh_;
  int colour_;
  double radius_;
  Vector3d at_;
};

}  // namespace

std::vector<std::vector<int>> far_groups(const std::vector<Vector3d>& points,
                                         std::size_t most_groups) {
  // In an order that has nothing to do with how the mesh was made; the same in each run.
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 chance(1);
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[chance() % k]);
  const auto at = [&](int k) { return points[static_cast<std::size_t>(k)]; };
  std::vector<std::vector<int>> out(std::min(most_groups, order.size()));
  for (const int point : order) {
    std::size_t best = 0;
    double furthest = -1.0;
    for (std::size_t g = 0; g < out.size(); ++g) {
      double nearest = HUGE_VAL;
      for (const int member : out[g]) {
        nearest = std::min(nearest, (at(member) - at(point)).squaredNorm());
        if (nearest <= furthest) break;
      }
      if (nearest <= furthest) continue;
      furthest = nearest;
      best = g;
    }
    out[best].push_back(point);
  }
  return out;
}

spatial::TouchFinders plane_touches(const TouchSurface& plane, const ContactMesh& mesh) {
  spatial::TouchFinders out;
  const double size = mesh.box().diagonal().norm();
  const std::vector<Vector3d> corners = mesh.sharp_corners();
  const std::size_t most = corners.size() > kMostSingleCorners ? kCornerGroups : corners.size();
  for (const std::vector<int>& group : far_groups(corners, most)) {
    std::vector<Vector3d> own;
    for (const int k : group) own.push_back(corners[static_cast<std::size_t>(k)]);
    out.push_back(std::make_shared<LowestCorner>(plane, std::move(own), size));
  }
  return out;
}

spatial::TouchFinders sphere_touches(const std::shared_ptr<const ContactMesh>& mesh, double radius,
                                     const Vector3d& at) {
  spatial::TouchFinders out;
  for (int colour = 0; colour < mesh->num_colours(); ++colour) {
    out.push_back(std::make_shared<SphereAtPatch>(mesh, colour, radius, at));
  }
  return out;
}

}  // namespace buckens::loads
