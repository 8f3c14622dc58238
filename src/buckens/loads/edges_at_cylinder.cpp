// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
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
// Of the smaller body, by which places that touch nothing have to be nearer than those that may.
constexpr double kBesideRim = 1e-2;
// Of the depth: if the end of an edge is nearer to a place and inside, too, it is the place.
constexpr double kNearEdgeEnd = 0.5;
// Of the way along an edge, by which a place further on may be higher.
constexpr double kFurtherAlong = 1e-5;
// Of the smaller body, by which places on an edge are apart.
constexpr double kSameOnEdge = 1e-7;

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
        tree(boxes_of(mesh->edge_boxes(), numbers), std::vector<std::uint32_t>(numbers.size(), 1U)),
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
  /// Whether a point is in the cylinder.
  bool holds(const Vector3d& x, const MarkerMotion& M) const {
    return cylinder.look(M.R.transpose() * (x - M.p), false).distance <= mesh->same();
  }
};

/// Where a cylinder is at an edge: at its side, or at one of two places of either rim.
struct Feature {
  double end = 0;      // 0: the side; 1 or −1: the rim
  double towards = 0;  // of the rim: 1 or −1
};
constexpr std::array<Feature, 5> kFeatures = {
    {{0.0, 0.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}}};

/// One feature of the cylinder at one edge.
struct AtEdge {
  std::size_t edge = 0, feature = 0;
  bool touches = false;
  double order = HUGE_VAL;  // the gap where it touches
  double along = 0;         // where on the edge, from its middle [m]
};

/// The places of a cylinder at some edges.
class CylinderOverEdges {
 public:
  CylinderOverEdges(std::shared_ptr<const Polyhedron> mesh, std::vector<int> group,
                    const TouchSurface& cylinder)
      : from_(std::move(mesh), std::move(group), cylinder),
        half_(cylinder.half_length * cylinder.axis) {
    for (const double end : {1.0, -1.0}) {
      own_box_.extend(box_around_disc(end * half_, cylinder.axis, cylinder.radius));
    }
  }

  /// The nearest ones; of several that are alike, the last towards either end of the edge: what an
  /// edge and a cylinder have in common is straight, and has two ends.
  std::array<AtEdge, 2> find(const RelativePose& pose) const {
    return memory_.at(pose, [this](const RelativePose& at) { return search(at); });
  }
  void set(const AtEdge& found, const MarkerMotion& F, const MarkerMotion& M,
           TouchPlace& out) const {
    const Feature& feature = kFeatures[found.feature];
    const SharpEdge& edge = from_.edges[found.edge];
    if (feature.end != 0.0) {
      spatial::set_rim_over_edge(edge, F, Rim::of(from_.cylinder, feature.end), M, feature.towards,
                                 out);
    } else if (found.touches) {
      spatial::set_segments({edge.middle, edge.half_length * edge.along, 0.0}, F,
                            {Vector3d::Zero(), half_, from_.cylinder.radius}, M, F.R.col(2), out);
    } else {
      set_beside(edge, F, M, out);
    }
    out.touches = found.touches;
    // What touches nothing is apart.
    if (!found.touches) out.gap = std::abs(out.gap);
  }

 private:
  std::array<AtEdge, 2> search(const RelativePose& pose) const {
    MarkerMotion M;
    M.p = pose.r;
    M.R = pose.R;
    const AlignedBox3d around = seen_from_first(pose, own_box_);
    std::array<AtEdge, 2> best;
    std::array<double, 2> least = {HUGE_VAL, HUGE_VAL};
    from_.tree.search(
        [&](const AlignedBox3d& box) { return std::sqrt(box.squaredExteriorDistance(around)); },
        [&](double distance, std::uint32_t /*marks*/) {
          return distance < std::max({least[0], least[1], from_.deepest()});
        },
        [&](int k) {
          const auto all = see_all(static_cast<std::size_t>(k), M);
          const int first = rank_of(*std::min_element(
              all.begin(), all.end(),
              [&](const AtEdge& a, const AtEdge& b) { return rank_of(a) < rank_of(b); }));
          for (const AtEdge& found : all) {
            if (rank_of(found) > first) continue;
            for (std::size_t end = 0; end < 2; ++end) {
              const double on = (end == 0 ? kFurtherAlong : -kFurtherAlong) * found.along;
              if (!(found.order - on < least[end])) continue;
              least[end] = found.order - on;
              best[end] = found;
            }
          }
        });
    // Two rows in one place would share its load without need.
    if (best[0].edge == best[1].edge &&
        std::abs(best[0].along - best[1].along) <= kSameOnEdge * from_.size) {
      best[1].touches = false;
    }
    return best;
  }

  std::array<AtEdge, kFeatures.size()> see_all(std::size_t k, const MarkerMotion& M) const {
    std::array<AtEdge, kFeatures.size()> out;
    for (std::size_t feature = 0; feature < out.size(); ++feature)
      out[feature] = see(k, feature, M);
    return out;
  }
  /// Places that touch come first, then those between the ends of the edge; an end, which may
  /// touch as a corner, hides none of them.
  int rank_of(const AtEdge& at) const {
    if (at.touches) return 0;
    return std::abs(at.along) < from_.edges[at.edge].half_length - kSameOnEdge * from_.size ? 1 : 2;
  }
  AtEdge see(std::size_t k, std::size_t feature, const MarkerMotion& M) const {
    AtEdge out{k, feature};
    double gap = 0.0;
    out.touches = kFeatures[feature].end != 0.0 ? see_rim(kFeatures[feature], M, out, gap)
                                                : see_side(M, out, gap);
    out.order = out.touches ? gap : std::abs(gap) + kBesideRim * from_.size;
    return out;
  }
  bool see_rim(const Feature& feature, const MarkerMotion& M, AtEdge& out, double& gap) const {
    const SharpEdge& edge = from_.edges[out.edge];
    TouchPlace place;
    const bool looks_out = spatial::set_rim_over_edge(
        edge, MarkerMotion{}, Rim::of(from_.cylinder, feature.end), M, feature.towards, place);
    gap = place.gap;
    const Vector3d half = 0.5 * place.gap * place.normal;
    out.along = edge.along.dot(place.place - edge.middle);
    return looks_out && from_.touch_at(out.edge, place.place - half, place.place + half, gap, M);
  }
  bool see_side(const MarkerMotion& M, AtEdge& out, double& gap) const {
    const Polyhedron::Edge& edge = from_.edge(out.edge);
    const Vector3d own = M.R * half_, r = M.p - edge.middle;
    const auto at = NearestOfSegments::of(r, edge.half, own);
    const Vector3d x = edge.middle + at.on_first * edge.half;
    const Vector3d between = r + at.on_second * own - at.on_first * edge.half;
    const double length = between.norm(), over = length - from_.cylinder.radius;
    out.along = at.on_first * from_.edges[out.edge].half_length;
    // What is further below the side than below the end is not at the side.
    const double off_the_end = (1.0 - std::abs(at.on_second)) * half_.norm();
    if (off_the_end > from_.mesh->same() && -over <= off_the_end && length > 0.0) {
      const Vector3d normal = between / length;
      gap = over;
      if (edge.looks_out(normal) && from_.touch_at(out.edge, x, x + over * normal, over, M)) {
        return true;
      }
    }
    gap = from_.cylinder.look(M.R.transpose() * (x - M.p), false).distance;
    return false;
  }
  /// The place of the edge that is nearest to the axis: a distance, with the rates of the body.
  void set_beside(const SharpEdge& edge, const MarkerMotion& F, const MarkerMotion& M,
                  TouchPlace& out) const {
    const Vector3d half = edge.half_length * edge.along;
    const auto at = NearestOfSegments::of(M.p - F.p - F.R * edge.middle, F.R * half, M.R * half_);
    const auto x = spatial::MovingPoint::of(F, edge.middle + at.on_first * half);
    spatial::set_sphere_at(from_.cylinder, M, x, 0.0, out);
    spatial::turn_round(out);
  }

  EdgesOfMesh from_;
  Vector3d half_;
  AlignedBox3d own_box_;  // in axes of the cylinder
  mutable PoseMemory<std::array<AtEdge, 2>> memory_;
};

/// One of its two places.
class CylinderAtEdges final : public spatial::TouchFinder {
 public:
  CylinderAtEdges(std::shared_ptr<const CylinderOverEdges> places, std::size_t end)
      : places_(std::move(places)), end_(end) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    places_->set(places_->find(RelativePose::of(F, M))[end_], F, M, out);
  }

 private:
  std::shared_ptr<const CylinderOverEdges> places_;
  std::size_t end_;
};

}  // namespace

spatial::TouchFinders edges_at_cylinder(const std::shared_ptr<const Polyhedron>& mesh,
                                        const TouchSurface& cylinder) {
  std::vector<Vector3d> middles;
  for (const Polyhedron::Edge& edge : mesh->edges()) middles.push_back(edge.middle);
  const std::size_t most = middles.size() > kMostSingleEdges ? kEdgeGroups : middles.size();
  spatial::TouchFinders out;
  for (std::vector<int>& group : far_groups(middles, most)) {
    const auto places = std::make_shared<const CylinderOverEdges>(mesh, std::move(group), cylinder);
    for (const std::size_t end : {0, 1}) {
      out.push_back(std::make_shared<CylinderAtEdges>(places, end));
    }
  }
  return out;
}

}  // namespace buckens::loads
