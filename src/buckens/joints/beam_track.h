// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/plane.h"

namespace buckens::joints {

/// A point of a deformed beam, between two of its nodes.
///
/// Weights multiply the position of the first node, its tangent, and those of the second, as in
/// c = w₀ p_a + w₁ t_a + w₂ p_b + w₃ t_b (R16); rates and accelerations of c follow from those of
/// the nodes with the same weights.
struct TrackPoint {
  double s = 0;             ///< along the undeformed beam from its first node [m]
  std::size_t element = 0;  ///< between nodes `element` and `element + 1`
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();  ///< [-], [m], [-], [m]
  Eigen::Vector4d slopes = Eigen::Vector4d::Zero();   ///< their derivatives by s
  spatial::MarkerMotion a, b;                         ///< motions of both nodes
  Eigen::Vector3d t_a, t_b;                           ///< tangents there
  Eigen::Vector3d p, tangent, curvature;              ///< c, c′, c″ by s
  Eigen::Vector3d side = Eigen::Vector3d::Zero();     ///< a direction that turns with the beam

  /// Velocity of the point of the beam.
  Eigen::Vector3d velocity() const;
  /// Rate of c′ at fixed s.
  Eigen::Vector3d tangent_rate() const;
  /// Acceleration of the point of the beam if accelerations of coordinates are zero.
  Eigen::Vector3d bias(const spatial::MarkerBias& a, const spatial::MarkerBias& b) const;
  /// Unit vectors across the beam. @param k 0 or 1; in a planar model 0, which lies in the plane
  Eigen::Vector3d across(int k) const;
  /// Derivatives of e·c with respect to the twists of both nodes, e fixed in the world.
  spatial::PairRow derivatives(const Eigen::Vector3d& e) const;
};

/// The line through the nodes of a beam: cubic Hermite interpolation between two nodes, as in the
/// beam's bending. Tangents are continuous across nodes, so that a slider experiences no jump
/// there.
///
/// Tangents turn with the nodes. On curved beams the tangent of a node is the mean of those of its
/// neighbours, so that the line is smooth where the elements have kinks.
class BeamTrack {
 public:
  /// Motion of a node by its number.
  using NodeMotion = std::function<spatial::MarkerMotion(std::size_t)>;

  BeamTrack() = default;
  /// @param nodes poses of two or more distinct nodes as placed
  /// @param planar plane of a planar model
  BeamTrack(const std::vector<spatial::MarkerMotion>& nodes,
            const std::optional<spatial::Plane>& planar);

  std::size_t num_nodes() const { return nodes_.size(); }
  /// Length of the undeformed beam [m].
  double length() const { return nodes_.empty() ? 0.0 : nodes_.back().s; }

  /// The point at s; the line is straight beyond the ends.
  TrackPoint at(double s, const NodeMotion& motion) const;

  /// The point nearest to a position, (place − c)·c′ = 0, by Newton's method.
  /// @param guess of s; none: starts from the nearest node
  TrackPoint nearest(const Eigen::Vector3d& place, const std::optional<double>& guess,
                     const NodeMotion& motion) const;

 private:
  struct Node {
    double s;                       // along the undeformed beam
    Eigen::Vector3d tangent, side;  // in axes of the node
  };
  std::size_t element_of(double s) const;
  double nearest_node(const Eigen::Vector3d& place, const NodeMotion& motion) const;

  std::vector<Node> nodes_;
};

}  // namespace buckens::joints
