// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/near_boxes.h"
#include "buckens/loads/polyhedron_touch.h"
#include "buckens/spatial/segment_pair.h"
#include "buckens/spatial/touch_features.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::MovingEdge;
using spatial::NearestOfSegments;
using spatial::RoundSegment;
using spatial::TouchPlace;

namespace {

// Of the smaller body, up to which edges are looked for inside the other one.
constexpr double kDeepestEdge = 0.1;
// Of the smaller body, by which places that touch nothing have to be nearer than those that may.
constexpr double kBesideCrossing = 3e-5;
// Of the smaller body, up to which groups of edges are looked for; beyond, the distance of what is
// around them says enough.
constexpr double kReachOfGroups = 0.1;
// Of the way along an edge, by which a crossing further on may be higher.
constexpr double kFurtherOn = 1e-5;
// Height over way along an edge, up to which its second crossing has a row of its own.
constexpr double kLiesOn = 0.05;
// Square of the sine between edges whose crossing has no place.
constexpr double kAlongEach = 1e-6;
// Of the depth: if the end of an edge is nearer to a crossing and inside, too, it is the place.
constexpr double kNearTheEnd = 0.5;

/// Two edges, and how they look at each other.
struct Crossing {
  int own = -1, other = -1;  // −1: none in reach
  bool touches = false;      // their gap has a sign
  double sign = 1.0;         // of the normal along (other × own)
  double gap = HUGE_VAL;
  double along = 0;  // where on the own edge, from its middle [m]
};

/// The edges of one body, or some of them, over all edges of another one.
class EdgesOverEdges {
 public:
  /// @param reach up to which they are looked for [m]
  EdgesOverEdges(std::shared_ptr<const Polyhedron> own, std::vector<int> edges,
                 std::shared_ptr<const Polyhedron> other, double reach)
      : own_(std::move(own)),
        other_(std::move(other)),
        edges_(std::move(edges)),
        boxes_(boxes_of(own_->edge_boxes(), edges_)),
        tree_(boxes_, std::vector<std::uint32_t>(edges_.size(), 1U)),
        other_tree_(other_->edge_boxes(), std::vector<std::uint32_t>(other_->edges().size(), 1U)),
        reach_(reach) {
    const double size = std::min(own_->size(), other_->size());
    // Where edges are short, corners between them are inside sooner than that.
    deepest_ = std::min({kDeepestEdge * size, longest(*own_), longest(*other_)});
    beside_ = kBesideCrossing * size;
    same_ = std::max(own_->same(), other_->same());
  }

  /// Towards either end of the own edges. @param pose of the own body in axes of the other one
  std::array<Crossing, 2> find(const RelativePose& pose) const {
    return memory_.at(pose, [this](const RelativePose& at) { return search(at); });
  }
  /// No more than the distance, where nothing is in reach [m].
  double beyond(const RelativePose& pose) const {
    const AlignedBox3d own = seen_from_first(pose, tree_.box());
    return std::max(reach_, std::sqrt(other_tree_.box().squaredExteriorDistance(own)));
  }
  const Polyhedron::Edge& own(int k) const { return own_->edges()[static_cast<std::size_t>(k)]; }
  const Polyhedron::Edge& other(int k) const {
    return other_->edges()[static_cast<std::size_t>(k)];
  }

 private:
  /// Half the longest edge [m].
  static double longest(const Polyhedron& body) {
    double out = 0.0;
    for (const Polyhedron::Edge& edge : body.edges()) out = std::max(out, edge.half.norm());
    return out;
  }

  std::array<Crossing, 2> search(const RelativePose& pose) const {
    std::array<Crossing, 2> best;
    // Of those that touch, for part(); beyond them an edge that dips has one place, the lowest.
    std::array<Crossing, 8> near;
    std::size_t num_near = 0;
    std::array<double, 2> least = {reach_, reach_};
    const auto limit = [&] { return std::max({least[0], least[1], deepest_}); };
    tree_.search(
        [&](const AlignedBox3d& box) {
          return distance_to_nearest(other_tree_, other_->edge_boxes(), seen_from_first(pose, box),
                                     deepest_);
        },
        [&](double distance, std::uint32_t /*marks*/) { return distance < limit(); },
        [&](int k) {
          const int own_edge = edges_[static_cast<std::size_t>(k)];
          const AlignedBox3d box = seen_from_first(pose, boxes_[static_cast<std::size_t>(k)]);
          other_tree_.search(
              [&](const AlignedBox3d& node) { return node.squaredExteriorDistance(box); },
              [&](double square, std::uint32_t /*marks*/) { return square < limit() * limit(); },
              [&](int other_edge) {
                const Crossing found = cross(pose, own_edge, other_edge);
                if (found.touches && num_near < near.size()) near[num_near++] = found;
                const double order = found.touches ? found.gap : found.gap + beside_;
                for (std::size_t end = 0; end < 2; ++end) {
                  const double on = (end == 0 ? kFurtherOn : -kFurtherOn) * found.along;
                  if (!(order - on < least[end])) continue;
                  least[end] = order - on;
                  best[end] = found;
                }
              });
        });
    if (best[0].own == best[1].own && best[0].other == best[1].other) {
      part(best, {near.begin(), near.begin() + num_near});
    }
    return best;
  }

  /// An edge that lies on a face has a row at either border of it, also where it dips more at one
  /// of them: a single row would go to and fro between both. Where there is no second crossing, two
  /// rows in one place would share its load without need.
  static void part(std::array<Crossing, 2>& best, std::span<const Crossing> near) {
    const Crossing lowest = best[0];
    double least = HUGE_VAL;
    best[1].touches = false;
    if (!lowest.touches) return;
    for (const Crossing& found : near) {
      if (found.own != lowest.own || found.other == lowest.other) continue;
      const double over = found.gap - lowest.gap;
      if (over > kLiesOn * std::abs(found.along - lowest.along) || !(over < least)) continue;
      least = over;
      const bool is_further = found.along > lowest.along;
      best = is_further ? std::array{found, lowest} : std::array{lowest, found};
    }
  }

  Crossing cross(const RelativePose& pose, int own_edge, int other_edge) const {
    const Polyhedron::Edge &a = own(own_edge), &b = other(other_edge);
    const Vector3d r = pose.r + pose.R * a.middle - b.middle, half = pose.R * a.half;
    const auto at = NearestOfSegments::of(r, b.half, half);
    const Vector3d between = r + at.on_second * half - at.on_first * b.half;
    Crossing out{own_edge, other_edge, false, 1.0, between.norm(), at.on_second * half.norm()};
    const Vector3d across = b.half.cross(half);
    const double size = across.norm();
    const double lengths = b.half.squaredNorm() * half.squaredNorm();
    if (!(size * size > kAlongEach * lengths)) return out;
    Vector3d normal = across / size;
    const Vector3d own_normal = pose.R.transpose() * normal;
    if (b.looks_out(normal) && a.looks_out(-own_normal)) {
      out.sign = 1.0;
    } else if (b.looks_out(-normal) && a.looks_out(own_normal)) {
      out.sign = -1.0;
    } else {
      return out;
    }
    out.touches = touch_at(pose, {&b, at.on_first}, {&a, at.on_second}, out.sign * normal.dot(r));
    if (out.touches) out.gap = out.sign * normal.dot(r);
    return out;
  }

  /// A place of an edge, from its middle in halves of it.
  struct Place {
    const Polyhedron::Edge* edge;
    double at;
    Vector3d x() const { return edge->middle + at * edge->half; }
    Vector3d end() const { return edge->middle + (at < 0.0 ? -1.0 : 1.0) * edge->half; }
    double off_the_end() const { return (1.0 - std::abs(at)) * edge->half.norm(); }
  };

  /// Whether edges that look at each other touch there, or overlap; no ends do, which are corners'
  /// places.
  bool touch_at(const RelativePose& pose, const Place& other, const Place& own, double gap) const {
    if (!(other.off_the_end() > same_) || !(own.off_the_end() > same_)) return false;
    if (gap >= -same_) return true;
    if (gap < -deepest_) return false;
    const auto in_other = [&](const Vector3d& x) { return other_->holds(pose.r + pose.R * x); };
    const auto in_own = [&](const Vector3d& x) {
      return own_->holds(pose.R.transpose() * (x - pose.r));
    };
    if (!in_other(own.x()) || !in_own(other.x())) return false;
    const double near = -kNearTheEnd * gap;
    return !(own.off_the_end() < near && in_other(own.end())) &&
           !(other.off_the_end() < near && in_own(other.end()));
  }

  std::shared_ptr<const Polyhedron> own_, other_;
  std::vector<int> edges_;
  std::vector<AlignedBox3d> boxes_;
  BoxTree tree_, other_tree_;
  double reach_, deepest_ = 0, beside_ = 0, same_ = 0;
  mutable PoseMemory<std::array<Crossing, 2>> memory_;
};

/// Of some edges of one body, the lowest crossing with edges of the other, the last of several
/// towards one end.
class EdgesAcross final : public spatial::TouchFinder {
 public:
  /// @param end 0 or 1, @param is_second the own edges are those of M
  EdgesAcross(std::shared_ptr<const EdgesOverEdges> edges, std::size_t end, bool is_second)
      : edges_(std::move(edges)), end_(end), is_second_(is_second) {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const MarkerMotion& other = is_second_ ? F : M;
    const MarkerMotion& own = is_second_ ? M : F;
    const RelativePose pose = RelativePose::of(other, own);
    set_place(edges_->find(pose)[end_], pose, other, own, out);
    if (!is_second_) turn_round(out);
  }

 private:
  void set_place(const Crossing& found, const RelativePose& pose, const MarkerMotion& other,
                 const MarkerMotion& own, TouchPlace& out) const {
    out.touches = found.touches;
    if (found.own < 0) {
      out.gap = edges_->beyond(pose);
      out.normal = own.R.col(2);
      out.normal_rate = own.w.cross(out.normal);
      out.place = own.p;
      out.place_rate = own.v;
      return;
    }
    const Polyhedron::Edge &a = edges_->own(found.own), &b = edges_->other(found.other);
    const Vector3d half = own.R * a.half, other_half = other.R * b.half;
    const Vector3d along = found.sign * other_half.cross(half);
    if (found.touches) {
      return set_crossing(MovingEdge{&other, other.p + other.R * b.middle, other_half},
                          MovingEdge{&own, own.p + own.R * a.middle, half}, along, out);
    }
    const double size = along.norm();
    const Vector3d otherwise = size > 0.0 ? Vector3d(along / size) : Vector3d(own.R.col(2));
    set_segments(RoundSegment{b.middle, b.half, 0.0}, other, RoundSegment{a.middle, a.half, 0.0},
                 own, otherwise, out);
  }

  std::shared_ptr<const EdgesOverEdges> edges_;
  std::size_t end_;
  bool is_second_;
};

}  // namespace

TouchFinders edges_across(const std::shared_ptr<const Polyhedron>& first,
                          const std::shared_ptr<const Polyhedron>& second) {
  if (first->edges().empty() || second->edges().empty()) return {};
  const bool is_second = second->edges().size() <= first->edges().size();
  const auto& own = is_second ? second : first;
  const auto& other = is_second ? first : second;
  std::vector<Vector3d> middles;
  for (const Polyhedron::Edge& edge : own->edges()) middles.push_back(edge.middle);
  const bool has_groups = middles.size() > kMostSingleEdges;
  const double reach =
      has_groups ? kReachOfGroups * std::min(own->size(), other->size()) : HUGE_VAL;
  TouchFinders out;
  for (std::vector<int>& group : far_groups(middles, has_groups ? kEdgeGroups : middles.size())) {
    const auto edges = std::make_shared<const EdgesOverEdges>(own, std::move(group), other, reach);
    for (const std::size_t end : {0, 1}) {
      out.push_back(std::make_shared<EdgesAcross>(edges, end, is_second));
    }
  }
  return out;
}

}  // namespace buckens::loads
