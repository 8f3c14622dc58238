// SPDX-License-Identifier: Apache-2.0
// The line through the nodes of a beam against circles, cubics and differences.
#include "buckens/joints/beam_track.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using spatial::MarkerMotion;
using test::MarkerPath;

std::vector<MarkerMotion> nodes_on_arc(int elements, double radius, double angle) {
  std::vector<MarkerMotion> out;
  for (int k = 0; k <= elements; ++k) {
    const double a = angle * k / elements;
    MarkerMotion node;
    node.p = radius * Vector3d(std::cos(a), std::sin(a), 0);
    out.push_back(node);
  }
  return out;
}

TEST(BeamTrack, FollowsACircleToFourthOrder) {
  double before = 0;
  for (const int elements : {8, 16, 32}) {
    const auto nodes = nodes_on_arc(elements, 0.5, 2.0);
    const BeamTrack track(nodes, std::nullopt);
    double error = 0;
    for (int k = 0; k <= 300; ++k) {
      const TrackPoint at =
          track.at(track.length() * k / 300, [&](std::size_t n) { return nodes[n]; });
      error = std::max(error, std::abs(at.p.norm() - 0.5));
    }
    // Tangents are exact on a circle, chords shorter than arcs by h²/24: h⁴/128 of the radius.
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 4.0, 0.3) << elements;
    }
    before = error;
  }
}

/// Nodes of a straight beam that are displaced and turned by a cubic are joined by that cubic.
TEST(BeamTrack, IsTheBeamsOwnCubic) {
  const auto w = [](double x) { return 1e-6 * (x * x * x - 2 * x * x + 0.5 * x); };
  const auto slope = [](double x) { return 1e-6 * (3 * x * x - 4 * x + 0.5); };
  std::vector<MarkerMotion> nodes;
  for (const double x : {0.0, 0.7, 1.5, 2.0}) {
    nodes.emplace_back().p = {x, 0, 0};
  }
  const BeamTrack track(nodes, spatial::Plane::xy);
  for (MarkerMotion& node : nodes) {
    const double x = node.p.x();
    node.p.y() = w(x);
    node.R = spatial::exp_rotation({0, 0, slope(x)}).toRotationMatrix();
  }
  for (const double s : {0.0, 0.3, 0.7, 0.71, 1.2, 1.9, 2.0}) {
    const TrackPoint at = track.at(s, [&](std::size_t n) { return nodes[n]; });
    EXPECT_NEAR(at.p.y(), w(s), 1e-16);  // rotations are small: their squares are 1e-12 along x
    EXPECT_NEAR(at.tangent.y(), slope(s), 1e-16);
    EXPECT_NEAR(at.curvature.y(), 1e-6 * (6 * s - 4), 1e-15);
    EXPECT_NEAR(at.across(0).y(), 1.0 / std::hypot(1.0, slope(s)), 1e-15);
  }
}

class MovingTrack : public ::testing::Test {
 protected:
  MovingTrack() : track_(nodes_on_arc(3, 1.0, 1.5), std::nullopt) {
    const auto placed = nodes_on_arc(3, 1.0, 1.5);
    for (int k = 0; k < 4; ++k) {
      MarkerPath path = MarkerPath::some(k);
      path.p = placed[static_cast<std::size_t>(k)].p + 0.02 * path.p;
      path.R = spatial::exp_rotation({0.1 * k, -0.1, 0.05}).toRotationMatrix();
      paths_.push_back(path);
    }
  }
  TrackPoint at(double s, double t) const {
    return track_.at(s, [&](std::size_t n) { return paths_[n].at(t); });
  }

  BeamTrack track_;
  std::vector<MarkerPath> paths_;
};

TEST_F(MovingTrack, IsSmoothAcrossNodes) {
  const double node = track_.length() / 3;
  const TrackPoint before = at(node - 1e-12, 0.1);
  const TrackPoint after = at(node + 1e-12, 0.1);
  EXPECT_NE(before.element, after.element);
  EXPECT_NEAR((before.p - after.p).norm(), 0, 1e-11);
  EXPECT_NEAR((before.tangent - after.tangent).norm(), 0, 1e-10);
  EXPECT_NEAR((before.velocity() - after.velocity()).norm(), 0, 1e-10);
  EXPECT_NEAR((before.across(0) - after.across(0)).norm(), 0, 1e-10);
}

TEST_F(MovingTrack, RatesAndAccelerationsAreThoseOfThePoint) {
  for (const double s : {0.1, 0.6, 1.3}) {
    const TrackPoint now = at(s, 0);
    const Vector3d v = test::derivative([&](double t) { return at(s, t).p; });
    const Vector3d a = test::second_derivative([&](double t) { return at(s, t).p; });
    const Vector3d along = test::derivative([&](double x) { return at(s + x, 0).p; });
    const Vector3d bend = test::second_derivative([&](double x) { return at(s + x, 0).p; });
    const Vector3d tangent_rate = test::derivative([&](double t) { return at(s, t).tangent; });
    // Fourth-order differences over 1e-3: 1e-11 of quantities of one, second ones 1e-8 by rounding.
    EXPECT_NEAR((now.velocity() - v).norm(), 0, 1e-9);
    EXPECT_NEAR((now.tangent - along).norm(), 0, 1e-9);
    EXPECT_NEAR((now.curvature - bend).norm(), 0, 1e-7);
    EXPECT_NEAR((now.tangent_rate() - tangent_rate).norm(), 0, 1e-9);
    const auto& first = paths_[now.element];
    const auto& second = paths_[now.element + 1];
    EXPECT_NEAR((now.bias({first.alpha, first.a}, {second.alpha, second.a}) - a).norm(), 0, 1e-6);
    const Vector3d e(0.3, -0.8, 0.4);
    Eigen::Matrix<double, 12, 1> V;
    V << first.w, first.v, second.w, second.v;
    EXPECT_NEAR(now.derivatives(e).dot(V), e.dot(v), 1e-9);
  }
}

TEST_F(MovingTrack, FindsTheNearestPointAlsoBeyondItsEnds) {
  const auto motion = [&](std::size_t n) { return paths_[n].at(0); };
  for (const double s : {-0.05, 0.02, 0.4999, 0.5001, 1.2, 1.6}) {
    const TrackPoint there = at(s, 0);
    const Vector3d place = there.p + 0.02 * there.across(0) - 0.01 * there.across(1);
    for (const std::optional<double> guess : {std::optional<double>(), std::optional(s + 0.1)}) {
      const TrackPoint found = track_.nearest(place, guess, motion);
      EXPECT_NEAR(found.s, s, 1e-13);
      EXPECT_NEAR((place - found.p).dot(found.tangent), 0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace buckens::joints
