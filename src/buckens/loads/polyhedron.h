// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/loads/contact_mesh.h"

namespace buckens::loads {

/// A surface of triangles as another one touches it without a stiffness: flat faces, and the sharp
/// corners and edges that stand out of it. Theory: docs/theory/25-contact.md §4.
class Polyhedron {
 public:
  struct Corner {
    Eigen::Vector3d at;                  ///< [m]
    std::vector<Eigen::Vector3d> along;  ///< unit vectors from there along the edges of its facets
  };
  /// Straight, between two faces, or on the border of an open surface.
  struct Edge {
    Eigen::Vector3d middle, half;         ///< [m]
    std::array<Eigen::Vector3d, 2> into;  ///< unit vectors across it into both faces

    /// Whether a direction at right angles to the edge points out of the solid, or nearly so.
    bool looks_out(const Eigen::Vector3d& direction) const;
  };
  /// What a sharp corner of another solid sees of the surface.
  struct Sight {
    int facet = -1;
    /// Over a face, or come through it: along its normal. Else it is beside, or came in elsewhere:
    /// to the nearest place of the facet, whichever side that is seen from.
    bool is_across = false;
    double gap = 0;  ///< negative: inside [m]
  };

  explicit Polyhedron(const ContactMesh& mesh);
  explicit Polyhedron(const spatial::TriangleList& list);

  /// Where a corner is nearest, or, inside, through which face it came: the nearest one that all
  /// the corner's edges lie outside of.
  /// @param x where the corner is, @param R orientation of its axes
  /// @param deepest to which it is looked for inside [m]
  Sight see(const Eigen::Vector3d& x, const Eigen::Matrix3d& R, const Corner& corner,
            double deepest) const;
  /// A facet as a point sees it that is beside it: its nearest place, whichever side that is seen
  /// from. @param facet of faces()
  spatial::TouchSurface::View beside(int facet, const Eigen::Vector3d& x) const;
  /// Whether a point is inside, or on the surface.
  bool holds(const Eigen::Vector3d& x) const { return flat_.nearest(x).distance <= same_; }

  const std::vector<Corner>& corners() const { return corners_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// Its triangles, all of them flat.
  const ContactMesh& faces() const { return flat_; }
  /// Unit vector. @param facet of faces()
  const Eigen::Vector3d& normal(int facet) const {
    return normals_[static_cast<std::size_t>(facet)];
  }
  /// Boxes around the triangles, and around the edges.
  const std::vector<Eigen::AlignedBox3d>& face_boxes() const { return face_boxes_; }
  const std::vector<Eigen::AlignedBox3d>& edge_boxes() const { return edge_boxes_; }
  double size() const { return flat_.box().diagonal().norm(); }
  /// Below which lengths are the same [m].
  double same() const { return same_; }

 private:
  ContactMesh flat_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::vector<Eigen::AlignedBox3d> face_boxes_, edge_boxes_;
  double same_ = 0;
};

}  // namespace buckens::loads
