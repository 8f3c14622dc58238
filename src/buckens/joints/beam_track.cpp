// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/beam_track.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace buckens::joints {

using Eigen::Vector3d;
using Eigen::Vector4d;
using spatial::MarkerMotion;

namespace {

constexpr int kMostSteps = 50;

/// Arc tangents at the nodes of a line: of the parabola through a node and its neighbours, which is
/// exact to second order; straight lines keep theirs.
std::vector<Vector3d> tangents_of(const std::vector<MarkerMotion>& nodes) {
  const std::size_t count = nodes.size();
  std::vector<Vector3d> chords;
  std::vector<double> lengths;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Vector3d chord = nodes[k + 1].p - nodes[k].p;
    lengths.push_back(chord.norm());
    chords.push_back(chord / lengths.back());
  }
  std::vector<Vector3d> out(count);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    out[k] = (lengths[k] * chords[k - 1] + lengths[k - 1] * chords[k]).normalized();
  }
  // The end of a parabola: its chord, turned as far beyond as the inner tangent is before.
  const auto end = [&](const Vector3d& chord, const Vector3d& inner) {
    return Vector3d(2.0 * chord.dot(inner) * chord - inner).normalized();
  };
  out.front() = count == 2 ? chords.front() : end(chords.front(), out[1]);
  out.back() = count == 2 ? chords.back() : end(chords.back(), out[count - 2]);
  return out;
}

/// The axis of the world that the tangents stay farthest away from.
Vector3d direction_aside(const std::vector<Vector3d>& tangents) {
  Vector3d best = Vector3d::UnitZ();
  double most = -1.0;
  for (const int axis : {2, 1, 0}) {
    const Vector3d direction = Vector3d::Unit(axis);
    double least = 1.0;
    for (const Vector3d& t : tangents) least = std::min(least, t.cross(direction).norm());
    if (least <= most) continue;
    most = least;
    best = direction;
  }
  return best;
}

/// Sets Hermite's shapes; straight on beyond the ends.
void set_shapes(double x, double L, bool is_first, bool is_last, TrackPoint& out) {
  if (is_first && x < 0.0) {
    out.weights = {1, x * L, 0, 0};
    out.slopes = {0, 1, 0, 0};
    return;
  }
  if (is_last && x > 1.0) {
    out.weights = {0, 0, 1, (x - 1) * L};
    out.slopes = {0, 0, 0, 1};
    return;
  }
  const double y = 1 - x;
  out.weights = {y * y * (1 + 2 * x), x * y * y * L, x * x * (1 + 2 * y), -x * x * y * L};
  out.slopes = {-6 * x * y / L, y * (1 - 3 * x), 6 * x * y / L, x * (3 * x - 2)};
}

Vector4d bends_of(double x, double L, const TrackPoint& at) {
  // Of the straight lines beyond the ends there are none.
  if (x < 0.0 && at.weights[2] == 0.0) return Vector4d::Zero();
  if (x > 1.0 && at.weights[0] == 0.0) return Vector4d::Zero();
  return Vector4d(12 * x - 6, (6 * x - 4) * L, 6 - 12 * x, (6 * x - 2) * L) / (L * L);
}

Vector3d combine(const Vector4d& w, const Vector3d& a, const Vector3d& da, const Vector3d& b,
                 const Vector3d& db) {
  return w[0] * a + w[1] * da + w[2] * b + w[3] * db;
}

}  // namespace

Vector3d TrackPoint::velocity() const {
  return combine(weights, a.v, a.w.cross(t_a), b.v, b.w.cross(t_b));
}

Vector3d TrackPoint::tangent_rate() const {
  return combine(slopes, a.v, a.w.cross(t_a), b.v, b.w.cross(t_b));
}

Vector3d TrackPoint::bias(const spatial::MarkerBias& of_a, const spatial::MarkerBias& of_b) const {
  const auto turned = [](const spatial::MarkerBias& bias, const Vector3d& w, const Vector3d& t) {
    return Vector3d(bias.alpha.cross(t) + w.cross(w.cross(t)));
  };
  return combine(weights, of_a.a, turned(of_a, a.w, t_a), of_b.a, turned(of_b, b.w, t_b));
}

Vector3d TrackPoint::across(int k) const {
  const Vector3d t = tangent.normalized();
  const Vector3d first = side.cross(t).normalized();
  return k == 0 ? first : Vector3d(t.cross(first));
}

spatial::PairRow TrackPoint::derivatives(const Vector3d& e) const {
  spatial::PairRow J;
  J << weights[1] * t_a.cross(e).transpose(), weights[0] * e.transpose(),
      weights[3] * t_b.cross(e).transpose(), weights[2] * e.transpose();
  return J;
}

BeamTrack::BeamTrack(const std::vector<MarkerMotion>& nodes,
                     const std::optional<spatial::Plane>& planar) {
  const std::vector<Vector3d> tangents = tangents_of(nodes);
  const Vector3d side = planar ? spatial::normal(*planar) : direction_aside(tangents);
  double s = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k > 0) s += (nodes[k].p - nodes[k - 1].p).norm();
    nodes_.push_back({s, nodes[k].R.transpose() * tangents[k], nodes[k].R.transpose() * side});
  }
}

std::size_t BeamTrack::element_of(double s) const {
  const auto next = std::upper_bound(nodes_.begin(), nodes_.end(), s,
                                     [](double at, const Node& node) { return at < node.s; });
  const auto after = static_cast<std::size_t>(next - nodes_.begin());
  return std::clamp<std::size_t>(after, 1, nodes_.size() - 1) - 1;
}

TrackPoint BeamTrack::at(double s, const NodeMotion& motion) const {
  TrackPoint out;
  out.s = s;
  out.element = element_of(s);
  const Node& first = nodes_[out.element];
  const Node& second = nodes_[out.element + 1];
  const double L = second.s - first.s;
  const double x = (s - first.s) / L;
  set_shapes(x, L, out.element == 0, out.element + 2 == nodes_.size(), out);
  out.a = motion(out.element);
  out.b = motion(out.element + 1);
  out.t_a = out.a.R * first.tangent;
  out.t_b = out.b.R * second.tangent;
  out.p = combine(out.weights, out.a.p, out.t_a, out.b.p, out.t_b);
  out.tangent = combine(out.slopes, out.a.p, out.t_a, out.b.p, out.t_b);
  out.curvature = combine(bends_of(x, L, out), out.a.p, out.t_a, out.b.p, out.t_b);
  const double share = std::clamp(x, 0.0, 1.0);
  out.side = (1.0 - share) * (out.a.R * first.side) + share * (out.b.R * second.side);
  return out;
}

double BeamTrack::nearest_node(const Vector3d& place, const NodeMotion& motion) const {
  double best = 0.0;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double distance = (motion(k).p - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = nodes_[k].s;
  }
  return best;
}

TrackPoint BeamTrack::nearest(const Vector3d& place, const std::optional<double>& guess,
                              const NodeMotion& motion) const {
  double s = guess ? *guess : nearest_node(place, motion);
  for (int k = 0;; ++k) {
    TrackPoint out = at(s, motion);
    const Vector3d off = place - out.p;
    const double steep = out.tangent.squaredNorm();
    // Beyond its centre of curvature a line has a farthest point; Newton would go there.
    const double slope = std::max(steep - off.dot(out.curvature), 0.1 * steep);
    const double limit = 0.1 * length();
    const double change = std::clamp(off.dot(out.tangent) / slope, -limit, limit);
    // The last change is below rounding of s, or the iteration hovers over the bend of a node.
    const double rounding = 1e-15 * (length() + place.norm());
    if (std::abs(change) <= rounding || k == kMostSteps) return out;
    s += change;
  }
}

}  // namespace buckens::joints
