// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/surface_points.h"

#include <utility>

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

// Points beside an edge are this share of the way to the middle of their piece away from it: what
// stands on a face is not held by the sides above it as well.
constexpr double kBesideEdge = 0.02;

/// Part of a facet, its corners given by their λ.
using Piece = std::array<Vector3d, 3>;

class Cutter {
 public:
  Cutter(double spacing, std::vector<SurfacePoints::Point>& out) : spacing_(spacing), out_(out) {}

  void cut(const CurvedFacet& facet, const std::array<bool, 3>& is_sharp) {
    const double area =
        0.5 * (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).norm();
    waiting_.assign(1, {{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, area});
    while (!waiting_.empty()) {
      const auto [piece, own] = waiting_.back();
      waiting_.pop_back();
      const std::size_t longest = longest_side(facet, piece);
      if (length(facet, piece, longest) <= spacing_) {
        place(facet, is_sharp, piece, own);
        continue;
      }
      const std::size_t next = (longest + 1) % 3, last = (longest + 2) % 3;
      const Vector3d middle = 0.5 * (piece[longest] + piece[next]);
      waiting_.push_back({{piece[longest], middle, piece[last]}, 0.5 * own});
      waiting_.push_back({{middle, piece[next], piece[last]}, 0.5 * own});
    }
  }

 private:
  static double length(const CurvedFacet& facet, const Piece& piece, std::size_t k) {
    const Vector3d d = piece[(k + 1) % 3] - piece[k];
    return (d[0] * facet.corner[0] + d[1] * facet.corner[1] + d[2] * facet.corner[2]).norm();
  }

  static std::size_t longest_side(const CurvedFacet& facet, const Piece& piece) {
    std::size_t longest = 0;
    for (const std::size_t k : {1U, 2U}) {
      if (length(facet, piece, k) > length(facet, piece, longest)) longest = k;
    }
    return longest;
  }

  static bool is_at_edge(const std::array<bool, 3>& is_sharp, const Piece& piece) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_sharp[k]) continue;
      const auto opposite = static_cast<Eigen::Index>((k + 2) % 3);
      for (const Vector3d& corner : piece) {
        if (corner[opposite] == 0.0) return true;
      }
    }
    return false;
  }

  void place(const CurvedFacet& facet, const std::array<bool, 3>& is_sharp, const Piece& piece,
             double area) {
    const Vector3d middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    if (!is_at_edge(is_sharp, piece)) {
      out_.push_back({facet.at(middle), area});
      return;
    }
    for (const Vector3d& corner : piece) {
      out_.push_back({facet.at(corner + kBesideEdge * (middle - corner)), area / 3.0});
    }
  }

  double spacing_;
  std::vector<SurfacePoints::Point>& out_;
  std::vector<std::pair<Piece, double>> waiting_;  // with their areas
};

std::vector<SurfacePoints::Point> spread(std::span<const CurvedFacet> facets,
                                         std::span<const std::array<bool, 3>> is_sharp,
                                         double spacing) {
  std::vector<SurfacePoints::Point> out;
  Cutter cutter(spacing, out);
  for (std::size_t k = 0; k < facets.size(); ++k) cutter.cut(facets[k], is_sharp[k]);
  return out;
}

BoxTree tree_of(const std::vector<SurfacePoints::Point>& points) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(points.size());
  for (const auto& point : points) boxes.emplace_back(point.at);
  return {boxes, std::vector<std::uint32_t>(points.size(), 0)};
}

}  // namespace

SurfacePoints::SurfacePoints(std::span<const CurvedFacet> facets,
                             std::span<const std::array<bool, 3>> is_sharp, double spacing)
    : SurfacePoints(spread(facets, is_sharp, spacing)) {}

SurfacePoints::SurfacePoints(std::vector<Point> points)
    : points_(std::move(points)), tree_(tree_of(points_)) {}

}  // namespace buckens::loads
