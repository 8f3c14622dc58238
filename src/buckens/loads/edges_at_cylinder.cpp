// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/loads/cylinder_over_mesh.h"
#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/loads/polyhedron_touch.h"
#include "buckens/spatial/rim_touch.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::NearestOfSegments;
using spatial::Rim;
using spatial::SharpEdge;
using spatial::TouchPlace;
using spatial::TouchSurface;

namespace {

// Of the smaller body, up to which edges are looked for inside a cylinder.
constexpr double kDeepestAtCylinder = 0.1;
// Of the smaller body, by which places that touch nothing have to be nearer than those that may,
// and by which what touches nothing is apart.
constexpr double kBesideRim = 3e-5, kApartFromSide = 1e-3;
// Of the depth: if the end of an edge is nearer to a place and inside, too, it is the place.
constexpr double kNearEdgeEnd = 0.5;

/// Some edges of a mesh of F, and a cylinder of M.
struct EdgesOfMesh {
  std::shared_ptr<const Polyhedron> mesh;
  std::vector<int> numbers;
  std::vector<SharpEdge> edges;  // of these numbers
  BoxTree tree;
  TouchSurface cylinder;
  double size;  // of the smaller body [m]

  EdgesOfMesh(std::shared_ptr<const Polyhedron> surface, std::vector<int> group,
              const TouchSurface& solid)
      : mesh(std::move(surface)),
        numbers(std::move(group)),
        tree(boxes_of(*mesh, numbers), std::vector<std::uint32_t>(numbers.size(), 1U)),
        cylinder(solid),
        size(std::min(mesh->size(), greatest_length(solid))) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const Polyhedron::Edge& from = edge(k);
      edges.push_back(
          {from.middle, from.half.normalized(), from.half.norm(), {-from.into[0], -from.into[1]}});
    }
  }

  const Polyhedron::Edge& edge(std::size_t k) const {
    return mesh->edges()[static_cast<std::size_t>(numbers[k])];
  }
  double deepest() const { return kDeepestAtCylinder * size; }

  /// Whether a place of an edge that looks at one of the cylinder belongs to both.
  /// @param x on the edge, @param other on the cylinder, in axes of F
  bool touch_at(std::size_t k, const Vector3d& x, const Vector3d& other, double gap,
                const MarkerMotion& M) const {
    const SharpEdge& own = edges[k];
    const double at = own.along.dot(x - own.middle);
    const double off_the_end = own.half_length - std::abs(at);
    if (!(off_the_end > mesh->same())) return false;
    if (gap >= -mesh->same()) return true;
    if (gap < -deepest() || !mesh->holds(other) || !holds(x, M)) return false;
    const Vector3d end = own.middle + std::copysign(own.half_length, at) * own.along;
    return !(off_the_end < -kNearEdgeEnd * gap && holds(end, M));
  }

 private:
  static std::vector<AlignedBox3d> boxes_of(const Polyhedron& mesh,
                                            const std::vector<int>& numbers) {
    std::vector<AlignedBox3d> out;
    for (const int k : numbers) out.push_back(mesh.edge_boxes()[static_cast<std::size_t>(k)]);
    return out;
  }
  /// Whether a point is in the cylinder.
  bool holds(const Vector3d& x, const MarkerMotion& M) const {
    return cylinder.look(M.R.transpose() * (x - M.p), false).distance <= mesh->same();
  }
};

/// One feature of the cylinder at the nearest of the edges.
class EdgeTouchFinder : public spatial::TouchFinder {
 public:
  EdgeTouchFinder(std::shared_ptr<const EdgesOfMesh> edges, const AlignedBox3d& own_box)
      : edges_(std::move(edges)), own_box_(own_box) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const Found found = memory_.at(RelativePose::of(F, M),
                                   [this](const RelativePose& pose) { return nearest(pose); });
    set(found.edge, found.touches, F, M, out);
    out.touches = found.touches;
    if (found.touches || out.gap > kApartFromSide * edges_->size) return;
    out.gap = std::abs(out.gap) + kApartFromSide * edges_->size;
  }

 protected:
  /// @param M in axes of the mesh, @param gap where it touches, else the distance [m]
  /// @return whether it touches
  virtual bool see(std::size_t edge, const MarkerMotion& M, double& gap) const = 0;
  virtual void set(std::size_t edge, bool touches, const MarkerMotion& F, const MarkerMotion& M,
                   TouchPlace& out) const = 0;
  const EdgesOfMesh& edges() const { return *edges_; }

 private:
  struct Found {
    std::size_t edge = 0;
    bool touches = false;
    double order = HUGE_VAL;
  };

  Found nearest(const RelativePose& pose) const {
    MarkerMotion M;
    M.p = pose.r;
    M.R = pose.R;
    const AlignedBox3d around = seen_from_first(pose, own_box_);
    Found best;
    edges_->tree.search(
        [&](const AlignedBox3d& box) { return std::sqrt(box.squaredExteriorDistance(around)); },
        [&](double distance, std::uint32_t /*marks*/) {
          return distance < std::max(best.order, edges_->deepest());
        },
        [&](int k) {
          Found found{static_cast<std::size_t>(k), false, 0.0};
          found.touches = see(found.edge, M, found.order);
          if (!found.touches) found.order = std::abs(found.order) + kBesideRim * edges_->size;
          if (found.order < best.order) best = found;
        });
    return best;
  }

  std::shared_ptr<const EdgesOfMesh> edges_;
  AlignedBox3d own_box_;  // of the feature, in axes of the cylinder
  mutable PoseMemory<Found> memory_;
};

class EdgesAtRim final : public EdgeTouchFinder {
 public:
  EdgesAtRim(std::shared_ptr<const EdgesOfMesh> edges, const Rim& rim, double towards)
      : EdgeTouchFinder(std::move(edges), box_around_disc(rim.middle, rim.axis, rim.radius)),
        rim_(rim),
        towards_(towards) {}

 private:
  bool see(std::size_t k, const MarkerMotion& M, double& gap) const override {
    TouchPlace place;
    const bool looks_out =
        spatial::set_rim_over_edge(edges().edges[k], MarkerMotion{}, rim_, M, towards_, place);
    gap = place.gap;
    const Vector3d half = 0.5 * place.gap * place.normal;
    return looks_out && edges().touch_at(k, place.place - half, place.place + half, place.gap, M);
  }
  void set(std::size_t k, bool /*touches*/, const MarkerMotion& F, const MarkerMotion& M,
           TouchPlace& out) const override {
    spatial::set_rim_over_edge(edges().edges[k], F, rim_, M, towards_, out);
  }

  Rim rim_;
  double towards_;
};

class EdgesAtSide final : public EdgeTouchFinder {
 public:
  EdgesAtSide(std::shared_ptr<const EdgesOfMesh> edges, const TouchSurface& cylinder)
      : EdgeTouchFinder(std::move(edges), box_around_axis(cylinder)),
        half_(cylinder.half_length * cylinder.axis),
        radius_(cylinder.radius) {}

 private:
  static AlignedBox3d box_around_axis(const TouchSurface& cylinder) {
    AlignedBox3d out;
    for (const double end : {1.0, -1.0}) {
      out.extend(box_around_disc(end * cylinder.half_length * cylinder.axis, cylinder.axis,
                                 cylinder.radius));
    }
    return out;
  }
  bool see(std::size_t k, const MarkerMotion& M, double& gap) const override {
    const Polyhedron::Edge& edge = edges().edge(k);
    const Vector3d own = M.R * half_, r = M.p - edge.middle;
    const auto at = NearestOfSegments::of(r, edge.half, own);
    const Vector3d x = edge.middle + at.on_first * edge.half;
    const Vector3d between = r + at.on_second * own - at.on_first * edge.half;
    const double length = between.norm(), over = length - radius_;
    // What is further below the side than below the end is not at the side.
    const double off_the_end = (1.0 - std::abs(at.on_second)) * half_.norm();
    if (off_the_end > edges().mesh->same() && -over <= off_the_end && length > 0.0) {
      const Vector3d normal = between / length;
      gap = over;
      if (edge.looks_out(normal) && edges().touch_at(k, x, x + over * normal, over, M)) return true;
    }
    gap = edges().cylinder.look(M.R.transpose() * (x - M.p), false).distance;
    return false;
  }
  void set(std::size_t k, bool touches, const MarkerMotion& F, const MarkerMotion& M,
           TouchPlace& out) const override {
    const Polyhedron::Edge& edge = edges().edge(k);
    if (touches) {
      return spatial::set_segments({edge.middle, edge.half, 0.0}, F,
                                   {Vector3d::Zero(), half_, radius_}, M, F.R.col(2), out);
    }
    // The place of the edge that is nearest to the axis: a distance, with the rates of the body.
    const auto at =
        NearestOfSegments::of(M.p - F.p - F.R * edge.middle, F.R * edge.half, M.R * half_);
    spatial::set_sphere_at(edges().cylinder, M,
                           spatial::MovingPoint::of(F, edge.middle + at.on_first * edge.half), 0.0,
                           out);
    spatial::turn_round(out);
  }

  Vector3d half_;
  double radius_;
};

}  // namespace

spatial::TouchFinders edges_at_cylinder(const std::shared_ptr<const Polyhedron>& mesh,
                                        const TouchSurface& cylinder) {
  std::vector<Vector3d> middles;
  for (const Polyhedron::Edge& edge : mesh->edges()) middles.push_back(edge.middle);
  const std::size_t most = middles.size() > kMostSingleEdges ? kEdgeGroups : middles.size();
  spatial::TouchFinders out;
  for (std::vector<int>& group : far_groups(middles, most)) {
    const auto edges = std::make_shared<const EdgesOfMesh>(mesh, std::move(group), cylinder);
    out.push_back(std::make_shared<EdgesAtSide>(edges, cylinder));
    for (const double end : {1.0, -1.0}) {
      for (const double towards : {1.0, -1.0}) {
        out.push_back(std::make_shared<EdgesAtRim>(edges, Rim::of(cylinder, end), towards));
      }
    }
  }
  return out;
}

}  // namespace buckens::loads
