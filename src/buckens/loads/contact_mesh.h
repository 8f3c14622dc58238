// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/loads/box_tree.h"
#include "buckens/loads/curved_facet.h"
#include "buckens/loads/surface_points.h"
#include "buckens/spatial/touch_surface.h"
#include "buckens/spatial/triangle_list.h"

namespace buckens::loads {

struct MeshTopology;

/// A surface of triangles that others touch.
///
/// Facets whose neighbours are inclined by no more than a given angle belong to one patch, which
/// has no edges inside: its facets bulge so that normals hardly jump. Patches meet in sharp edges.
/// Each patch has a colour, different from those of the patches around it, so that what touches
/// several of them at once can tell their places apart. Theory: docs/theory/25-contact.md §6.
class ContactMesh {
 public:
  /// Of patches; more than that share theirs.
  static constexpr int kMostColours = 8;

  /// Joins corners at the same place.
  /// @param smooth up to this inclination neighbours belong to one patch [rad]
  /// @param spacing of springs() [m]; 0: a fifth of the side of its mean face
  /// @throws InputError without a place if facets look to different sides, or all of them inwards
  ContactMesh(const spatial::TriangleList& triangles, double smooth, double spacing = 0);

  /// A place of the surface and the distance of a point from it.
  struct Nearest {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    /// Unit vector from the surface to the point, outwards.
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    double distance = 0;  ///< negative: inside [m]
    int facet = -1;       ///< −1: nothing found
  };
  /// The nearest place of the whole surface.
  Nearest nearest(const Eigen::Vector3d& point) const;
  /// The nearest place of each colour within reach; of those that other patches continue nearer to
  /// the point, none. @param out num_colours() of them
  void nearest_of_colours(const Eigen::Vector3d& point, double reach, std::span<Nearest> out) const;

  /// What a point outside sees of the nearest patch of one colour, up to its borders and not
  /// beyond.
  /// @param colour below num_colours()
  spatial::TouchSurface::View look(const Eigen::Vector3d& point, int colour) const;
  /// Corners in which facets of more than two planes meet, or which are on the border of an open
  /// surface; the others lie between those. Each place once.
  std::vector<Eigen::Vector3d> sharp_corners() const;

  int num_colours() const { return num_colours_; }
  int num_patches() const { return num_patches_; }
  std::size_t num_facets() const { return facets_.size(); }
  /// Corners of the flat triangle. @param facet below num_facets()
  const std::array<Eigen::Vector3d, 3>& corners(std::size_t facet) const {
    return facets_[facet].corner;
  }
  /// @param index below num_facets()
  const CurvedFacet& facet(std::size_t index) const { return facets_[index]; }
  /// @param facet below num_facets()
  int patch(std::size_t facet) const { return patches_[facet]; }
  /// Of a patch.
  int colour(int patch) const { return colours_[static_cast<std::size_t>(patch)]; }
  /// Its corners, in the order of its facets, each triangle with points of its own.
  spatial::TriangleList flat_triangles() const;
  const BoxTree& tree() const { return tree_; }
  /// Around the flat triangles.
  const Eigen::AlignedBox3d& box() const { return box_; }
  double area() const { return area_; }
  /// Springs spread over the surface, for contact with another mesh; made when first asked for.
  const SurfacePoints& springs() const;
  bool is_closed() const { return is_closed_; }

 private:
  ContactMesh(const MeshTopology& from, double spacing);
  Nearest finish(const Eigen::Vector3d& point, int facet, const CurvedFacet::Place& place) const;
  /// Direction out of the solid at a place; zero on the border of an open surface.
  Eigen::Vector3d outwards(int facet, const CurvedFacet::Place& place) const;
  /// Whether another patch goes on from the border of this one nearer to the point, or owns the
  /// border.
  bool goes_on(const Eigen::Vector3d& point, int facet, const CurvedFacet::Place& place) const;

  std::vector<CurvedFacet> facets_;
  std::vector<std::array<int, 3>> vertices_;    // of each facet
  std::vector<std::array<int, 3>> neighbours_;  // across its edges, −1: none
  std::vector<int> patches_;                    // of each facet
  std::vector<int> colours_;                    // of each patch
  std::vector<int> first_at_, at_vertex_;       // facets at each vertex, as in MeshTopology
  std::vector<Eigen::Vector3d> outwards_;       // at each vertex; zero on an open border
  BoxTree tree_;
  Eigen::AlignedBox3d box_;
  double area_ = 0, spacing_ = 0;
  int num_patches_ = 0, num_colours_ = 1;
  bool is_closed_ = false;
  mutable std::once_flag springs_made_;
  mutable std::optional<SurfacePoints> springs_;
};

}  // namespace buckens::loads
