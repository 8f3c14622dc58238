// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/loads/polyhedron_touch.h"
#include "buckens/loads/sharp_edges.h"
#include "buckens/spatial/place_along_axis.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::NearestOfSegments;
using spatial::TouchPlace;
using spatial::TouchSurface;

namespace {

// Looks along half an axis before the nearest place is refined.
constexpr std::size_t kLooksAtPatches = 8;
// Share of a half axis by which it goes on beyond the middle.
constexpr double kInCommon = 0.1;

/// The axis of a capsule of M at the nearest of some edges of F.
class AxisAtEdges final : public spatial::TouchFinder {
 public:
  AxisAtEdges(std::vector<Polyhedron::Edge> edges, const TouchSurface& capsule)
      : edges_(std::move(edges)),
        tree_(boxes_of(edges_), std::vector<std::uint32_t>(edges_.size(), 1U)),
        half_(capsule.half_length * capsule.axis),
        radius_(capsule.radius) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const std::size_t k =
        edges_.size() == 1 ? 0
                           : memory_.at(RelativePose::of(F, M),
                                        [this](const RelativePose& pose) { return nearest(pose); });
    const Polyhedron::Edge& edge = edges_[k];
    const Vector3d out_of = F.R * -(edge.into[0] + edge.into[1]).normalized();
    spatial::set_segments({edge.middle, edge.half, 0.0}, F, {Vector3d::Zero(), half_, radius_}, M,
                          out_of, out);
  }

 private:
  static std::vector<AlignedBox3d> boxes_of(const std::vector<Polyhedron::Edge>& edges) {
    std::vector<AlignedBox3d> out;
    for (const Polyhedron::Edge& edge : edges) {
      const Vector3d reach = edge.half.cwiseAbs();
      out.emplace_back(edge.middle - reach, edge.middle + reach);
    }
    return out;
  }

  std::size_t nearest(const RelativePose& pose) const {
    const Vector3d own = pose.R * half_, reach = own.cwiseAbs();
    const AlignedBox3d around(pose.r - reach, pose.r + reach);
    std::size_t best = 0;
    double least = HUGE_VAL;  // square of the distance
    tree_.search([&](const AlignedBox3d& box) { return box.squaredExteriorDistance(around); },
                 [&](double square, std::uint32_t /*marks*/) { return square < least; },
                 [&](int item) {
                   const auto k = static_cast<std::size_t>(item);
                   const Polyhedron::Edge& edge = edges_[k];
                   const Vector3d r = pose.r - edge.middle;
                   const auto at = NearestOfSegments::of(r, edge.half, own);
                   const double square =
                       (r + at.on_second * own - at.on_first * edge.half).squaredNorm();
                   if (!(square < least)) return;
                   least = square;
                   best = k;
                 });
    return best;
  }

  std::vector<Polyhedron::Edge> edges_;
  BoxTree tree_;
  Vector3d half_;
  double radius_;
  mutable PoseMemory<std::size_t> memory_;
};

/// Half the axis of a capsule of M at the patches of one colour of F: where it is nearest. Both
/// halves have the middle of the axis in common, so that a place that passes it has a row.
class HalfAxisAtPatches final : public spatial::TouchFinder {
 public:
  /// @param towards 1 or −1: the half
  HalfAxisAtPatches(std::shared_ptr<const ContactMesh> mesh, int colour,
                    const TouchSurface& capsule, double towards)
      : mesh_(std::move(mesh)), colour_(colour), capsule_(capsule), towards_(towards) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const RelativePose pose = RelativePose::of(F, M);
    const Found found = memory_.at(pose, [this](const RelativePose& at) { return nearest(at); });
    const Vector3d b = pose.R * (capsule_.half_length * capsule_.axis);
    spatial::set_on_axis(mesh_->look(pose.r + found.s * b, colour_), F, capsule_, M, found.s,
                         found.is_nearest, out);
    out.touches = found.is_nearest;
  }

 private:
  struct Found {
    double s = 0;
    bool is_nearest = false;  // of the places around it, too
  };

  Found nearest(const RelativePose& pose) const {
    const Vector3d b = pose.R * (capsule_.half_length * capsule_.axis);
    const auto see = [&](double s) { return mesh_->look(pose.r + s * b, colour_); };
    std::array<double, kLooksAtPatches + 1> s, distance;
    std::size_t best = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const double share = static_cast<double>(k) / kLooksAtPatches;
      s[k] = towards_ * (share - (1.0 - share) * kInCommon);
      distance[k] = see(s[k]).distance;
      if (distance[k] < distance[best]) best = k;
    }
    const double slope = towards_ * see(s[best]).normal.dot(b);
    if (slope == 0.0) return {s[best], true};
    // At an end beyond which it comes nearer, that end.
    if ((best == 0 && slope > 0.0) || (best == kLooksAtPatches && slope < 0.0)) {
      return {s[best], false};
    }
    const double before = s[best > 0 ? best - 1 : 0];
    const double after = s[std::min(best + 1, kLooksAtPatches)];
    return {spatial::least_along(see, b, std::min(before, after), s[best], std::max(before, after)),
            true};
  }

  std::shared_ptr<const ContactMesh> mesh_;
  int colour_;
  TouchSurface capsule_;
  double towards_;
  mutable PoseMemory<Found> memory_;
};

std::vector<int> curved_colours(const ContactMesh& mesh) {
  std::vector<char> is_curved(static_cast<std::size_t>(mesh.num_colours()));
  for (std::size_t k = 0; k < mesh.num_facets(); ++k) {
    if (mesh.facet(k).is_flat()) continue;
    is_curved[static_cast<std::size_t>(mesh.colour(mesh.patch(k)))] = 1;
  }
  std::vector<int> out;
  for (std::size_t c = 0; c < is_curved.size(); ++c) {
    if (is_curved[c] != 0) out.push_back(static_cast<int>(c));
  }
  return out;
}

}  // namespace

spatial::TouchFinders capsule_touches(const std::shared_ptr<const ContactMesh>& mesh,
                                      const TouchSurface& capsule) {
  spatial::TouchFinders out;
  for (const double end : {1.0, -1.0}) {
    const Vector3d at = end * capsule.half_length * capsule.axis;
    for (const auto& finder : sphere_touches(mesh, capsule.radius, at)) out.push_back(finder);
  }
  const std::vector<Polyhedron::Edge> edges = sharp_edges(*mesh);
  std::vector<Vector3d> middles;
  for (const Polyhedron::Edge& edge : edges) middles.push_back(edge.middle);
  const std::size_t most = middles.size() > kMostSingleEdges ? kEdgeGroups : middles.size();
  for (const std::vector<int>& group : far_groups(middles, most)) {
    std::vector<Polyhedron::Edge> own;
    for (const int k : group) own.push_back(edges[static_cast<std::size_t>(k)]);
    out.push_back(std::make_shared<AxisAtEdges>(std::move(own), capsule));
  }
  for (const int colour : curved_colours(*mesh)) {
    for (const double towards : {1.0, -1.0}) {
      out.push_back(std::make_shared<HalfAxisAtPatches>(mesh, colour, capsule, towards));
    }
  }
  return out;
}

}  // namespace buckens::loads
