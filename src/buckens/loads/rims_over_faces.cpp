// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/loads/cylinder_over_mesh.h"
#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/spatial/rim_touch.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::MovingPoint;
using spatial::Rim;
using spatial::TouchPlace;

namespace {

// Of the smaller body, up to which the lowest point of a rim is looked for inside.
constexpr double kDeepestRim = 0.1;
// Of the smaller body, by which places that touch nothing have to be nearer than those that may.
constexpr double kBesideFace = 1e-2;
// Cosine between a face and an end that looks away from it, by more than a body turns in a step.
constexpr double kLooksAway = 0.1;
// Of the depth, within which the face through which a point came in is the one asked about.
constexpr double kSameDepth = 1e-3;

/// The lowest points of one rim over some faces: the one that is nearest.
class RimOverFaces final : public spatial::TouchFinder {
 public:
  /// @param size of the smaller body [m]
  RimOverFaces(std::shared_ptr<const Polyhedron> mesh, std::vector<int> facets, Rim rim,
               double size)
      : mesh_(std::move(mesh)),
        facets_(std::move(facets)),
        tree_(boxes_of(mesh_->face_boxes(), facets_),
              std::vector<std::uint32_t>(facets_.size(), 1U)),
        rim_(std::move(rim)),
        deepest_(kDeepestRim * size),
        beside_(kBesideFace * size) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const Found found = memory_.at(RelativePose::of(F, M),
                                   [this](const RelativePose& pose) { return nearest(pose); });
    out.touches = found.touches;
    const Vector3d normal = F.R * mesh_->normal(found.facet), rate = F.w.cross(normal);
    const MovingPoint lowest = spatial::lowest_of_rim(rim_, M, normal, rate);
    const Vector3d x = F.R.transpose() * (lowest.x - F.p);
    if (!found.touches) {
      return spatial::set_sphere_at(mesh_->beside(found.facet, x), F, lowest, 0.0, out);
    }
    out.gap = height(found.facet, x);
    out.normal = normal;
    out.normal_rate = rate;
    out.place = lowest.x;
    out.place_rate = lowest.rate;
  }

 private:
  struct Found {
    int facet = 0;
    bool touches = false;
    double order = HUGE_VAL;
  };

  double height(int facet, const Vector3d& x) const {
    return mesh_->normal(facet).dot(x - mesh_->faces().corners(static_cast<std::size_t>(facet))[0]);
  }

  Found nearest(const RelativePose& pose) const {
    MarkerMotion M;
    M.p = pose.r;
    M.R = pose.R;
    const Vector3d middle = pose.r + pose.R * rim_.middle, axis = pose.R * rim_.axis;
    const AlignedBox3d around = box_around_disc(middle, axis, rim_.radius);
    Found best;
    tree_.search(
        [&](const AlignedBox3d& box) { return std::sqrt(box.squaredExteriorDistance(around)); },
        [&](double distance, std::uint32_t /*marks*/) {
          return distance < std::max(best.order, deepest_);
        },
        [&](int k) {
          const Found found = see(facets_[static_cast<std::size_t>(k)], M, axis);
          if (found.order < best.order) best = found;
        });
    return best;
  }

  /// @param M the cylinder in axes of the mesh, @param axis out of the end, likewise
  Found see(int facet, const MarkerMotion& M, const Vector3d& axis) const {
    const Vector3d& normal = mesh_->normal(facet);
    const Vector3d x = spatial::lowest_of_rim(rim_, M, normal, Vector3d::Zero()).x;
    const double over = height(facet, x), same = mesh_->same();
    const CurvedFacet& face = mesh_->faces().facet(static_cast<std::size_t>(facet));
    const bool is_over =
        axis.dot(normal) <= kLooksAway && face.nearest(x - over * normal).square <= same * same;
    if (is_over && (over > same || (over >= -deepest_ && came_through(facet, x, over, M, axis)))) {
      return {facet, true, over};
    }
    return {facet, false, std::sqrt(face.nearest(x).square) + beside_};
  }

  /// Whether a point inside came in through this face, not through another one.
  bool came_through(int facet, const Vector3d& x, double over, const MarkerMotion& M,
                    const Vector3d& axis) const {
    const Vector3d radial = (x - M.p - M.R * rim_.middle).normalized();
    const Vector3d tangent = axis.cross(radial);
    const Polyhedron::Corner corner{x, {-axis, -radial, tangent, -tangent}};
    const Polyhedron::Sight sight = mesh_->see(x, Eigen::Matrix3d::Identity(), corner, deepest_);
    if (sight.facet < 0 || !sight.is_across) return false;
    return std::abs(sight.gap - over) <= kSameDepth * std::abs(over) + mesh_->same() &&
           mesh_->normal(sight.facet).dot(mesh_->normal(facet)) > 1.0 - kSameDepth;
  }

  std::shared_ptr<const Polyhedron> mesh_;
  std::vector<int> facets_;
  BoxTree tree_;
  Rim rim_;
  double deepest_, beside_;
  mutable PoseMemory<Found> memory_;
};

/// Numbers of the facets of each flat face.
std::vector<std::vector<int>> facets_of_faces(const ContactMesh& mesh) {
  std::vector<std::vector<int>> out(static_cast<std::size_t>(mesh.num_patches()));
  for (std::size_t k = 0; k < mesh.num_facets(); ++k) {
    out[static_cast<std::size_t>(mesh.patch(k))].push_back(static_cast<int>(k));
  }
  return out;
}

}  // namespace

spatial::TouchFinders rims_over_faces(const std::shared_ptr<const Polyhedron>& mesh,
                                      const spatial::TouchSurface& cylinder) {
  const std::vector<std::vector<int>> faces = facets_of_faces(mesh->faces());
  std::vector<Vector3d> middles;
  for (const std::vector<int>& face : faces) {
    AlignedBox3d box;
    for (const int k : face) box.extend(mesh->face_boxes()[static_cast<std::size_t>(k)]);
    middles.emplace_back(box.center());
  }
  const double size = std::min(mesh->size(), greatest_length(cylinder));
  const std::size_t most = faces.size() > kMostSingleFaces ? kFaceGroups : faces.size();
  spatial::TouchFinders out;
  for (const std::vector<int>& group : far_groups(middles, most)) {
    std::vector<int> facets;
    for (const int k : group) {
      const std::vector<int>& face = faces[static_cast<std::size_t>(k)];
      facets.insert(facets.end(), face.begin(), face.end());
    }
    for (const double end : {1.0, -1.0}) {
      out.push_back(std::make_shared<RimOverFaces>(mesh, facets, Rim::of(cylinder, end), size));
    }
  }
  return out;
}

}  // namespace buckens::loads
