// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "buckens/loads/box_tree.h"
#include "buckens/loads/curved_facet.h"

namespace buckens::loads {

/// A surface cut into small pieces, each of which a point stands for: places of springs that are
/// spread over it. Theory: docs/theory/25-contact.md §6.
class SurfacePoints {
 public:
  struct Point {
    Eigen::Vector3d at;  ///< [m]
    double area;         ///< that it stands for [m²]
  };

  /// Halves facets along their longest sides until none is longer than the spacing.
  /// @param is_sharp whether an edge of the surface ends at the edge of a facet from corner k to
  /// the next; pieces there have points next to the edge, others one in their middle
  /// @param spacing [m]
  SurfacePoints(std::span<const CurvedFacet> facets, std::span<const std::array<bool, 3>> is_sharp,
                double spacing);

  const std::vector<Point>& points() const { return points_; }
  const BoxTree& tree() const { return tree_; }

 private:
  explicit SurfacePoints(std::vector<Point> points);

  std::vector<Point> points_;
  BoxTree tree_;
};

}  // namespace buckens::loads
