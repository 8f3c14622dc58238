// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

// Corners nearer than this share of the surface's size are one: files in single precision.
constexpr double kSamePlace = 1e-6;
// Share of the square of its longest edge below which a triangle has no area.
constexpr double kNoArea = 1e-9;

/// Gives points at one place one number, by a grid of cells of twice the tolerance.
class PlaceNumbers {
 public:
  PlaceNumbers(double tolerance, std::vector<Vector3d>& points)
      : tolerance_(tolerance), points_(points) {}

  int number(const Vector3d& point) {
    const Vector3d at = point / (2.0 * tolerance_);
    const std::array<std::int64_t, 3> cell = {cell_of(at.x()), cell_of(at.y()), cell_of(at.z())};
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find(key({cell[0] + i, cell[1] + j, cell[2] + k}));
          if (found == cells_.end()) continue;
          for (const int known : found->second) {
            const Vector3d& other = points_[static_cast<std::size_t>(known)];
            if ((other - point).lpNorm<Eigen::Infinity>() <= tolerance_) return known;
          }
        }
      }
    }
    const int out = static_cast<int>(points_.size());
    points_.push_back(point);
    cells_[key(cell)].push_back(out);
    return out;
  }

 private:
  static std::int64_t cell_of(double at) { return static_cast<std::int64_t>(std::floor(at)); }
  /// Cells of one key are told apart by the distance of their points.
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t out = 1469598103934665603ULL;
    for (const std::int64_t part : cell) {
      out = (out ^ static_cast<std::uint64_t>(part)) * 1099511628211ULL;
    }
    return out;
  }

  double tolerance_;
  std::vector<Vector3d>& points_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

std::string place_text(const Vector3d& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", p.x(), p.y(), p.z());
}

}  // namespace

MeshTopology::MeshTopology(const spatial::TriangleList& list, double smooth, int most_colours) {
  join_points(list);
  find_neighbours();
  require_outwards();
  find_patches(smooth);
  find_colours(most_colours);
}

double MeshTopology::angle(std::size_t triangle, std::size_t k) const {
  const auto& t = triangles[triangle];
  const Vector3d& at = points[static_cast<std::size_t>(t[k])];
  const Vector3d a = points[static_cast<std::size_t>(t[(k + 1) % 3])] - at;
  const Vector3d b = points[static_cast<std::size_t>(t[(k + 2) % 3])] - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

void MeshTopology::join_points(const spatial::TriangleList& list) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : list.points) box.extend(point);
  const double size = list.points.empty() ? 0.0 : box.diagonal().norm();
  if (!(size > 0.0)) throw InputError({}, "its triangles have no size");
  PlaceNumbers numbers(kSamePlace * size, points);
  for (const auto& given : list.triangles) {
    std::array<int, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = numbers.number(list.points[static_cast<std::size_t>(given[k])]);
    }
    std::array<Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = points[static_cast<std::size_t>(t[k])];
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double longest = std::max(
        {(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    if (!(normal.norm() > kNoArea * longest)) continue;
    triangles.push_back(t);
    normals.push_back(normal.normalized());
    areas.push_back(0.5 * normal.norm());
  }
  if (triangles.empty()) throw InputError({}, "none of its triangles has an area");
}

void MeshTopology::find_neighbours() {
  const std::array<int, 3> alone = {-1, -1, -1};
  neighbours.assign(triangles.size(), alone);
  struct Side {
    int triangle, edge;
  };
  std::map<std::pair<int, int>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges[std::minmax(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(
          {static_cast<int>(t), static_cast<int>(k)});
    }
  }
  is_closed = true;
  for (const auto& [ends, sides] : edges) {
    // Three or more, as where solids share an edge: none of them goes on into another.
    if (sides.size() != 2) {
      is_closed = false;
      continue;
    }
    const auto start = [&](const Side& s) {
      return triangles[static_cast<std::size_t>(s.triangle)][static_cast<std::size_t>(s.edge)];
    };
    if (start(sides[0]) == start(sides[1])) {
      throw InputError(
          {}, fmt::format("the triangles on both sides of its edge at {} look to different sides; "
                          "repair it where it was made, so that all look outwards",
                          place_text(points[static_cast<std::size_t>(ends.first)])));
    }
    for (std::size_t s = 0; s < 2; ++s) {
      neighbours[static_cast<std::size_t>(sides[s].triangle)]
                [static_cast<std::size_t>(sides[s].edge)] = sides[1 - s].triangle;
    }
  }
  first_at.assign(points.size() + 1, 0);
  for (const auto& t : triangles) {
    for (const int p : t) ++first_at[static_cast<std::size_t>(p) + 1];
  }
  for (std::size_t p = 0; p < points.size(); ++p) first_at[p + 1] += first_at[p];
  at_point.resize(3 * triangles.size());
  std::vector<int> next(first_at.begin(), first_at.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int p : triangles[t]) {
      at_point[static_cast<std::size_t>(next[static_cast<std::size_t>(p)]++)] = static_cast<int>(t);
    }
  }
}

void MeshTopology::require_outwards() const {
  if (!is_closed) return;
  double volume = 0.0;
  for (const auto& t : triangles) {
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  if (volume > 0.0) return;
  throw InputError({},
                   "its triangles look inwards; turn them over where it was made (corners run "
                   "counter-clockwise as seen from outside)");
}

void MeshTopology::find_patches(double smooth) {
  const double least = std::cos(smooth);
  patches.assign(triangles.size(), -1);
  std::vector<std::size_t> waiting;
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (patches[first] >= 0) continue;
    patches[first] = num_patches;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const std::size_t t = waiting.back();
      waiting.pop_back();
      for (const int neighbour : neighbours[t]) {
        if (neighbour < 0) continue;
        const auto n = static_cast<std::size_t>(neighbour);
        if (patches[n] >= 0 || normals[t].dot(normals[n]) < least) continue;
        patches[n] = num_patches;
        waiting.push_back(n);
      }
    }
    ++num_patches;
  }
}

void MeshTopology::find_colours(int most) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(num_patches));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto begin = static_cast<std::size_t>(first_at[p]);
    const auto end = static_cast<std::size_t>(first_at[p + 1]);
    for (std::size_t a = begin; a < end; ++a) {
      const int one = patches[static_cast<std::size_t>(at_point[a])];
      for (std::size_t b = begin; b < end; ++b) {
        const int other = patches[static_cast<std::size_t>(at_point[b])];
        if (one != other) around[static_cast<std::size_t>(one)].push_back(other);
      }
    }
  }
  colours.assign(static_cast<std::size_t>(num_patches), -1);
  std::vector<int> uses(static_cast<std::size_t>(most));
  for (std::size_t patch = 0; patch < colours.size(); ++patch) {
    std::fill(uses.begin(), uses.end(), 0);
    for (const int other : around[patch]) {
      const int colour = colours[static_cast<std::size_t>(other)];
      if (colour >= 0) ++uses[static_cast<std::size_t>(colour)];
    }
    const auto least = std::min_element(uses.begin(), uses.end());
    colours[patch] = static_cast<int>(least - uses.begin());
    num_colours = std::max(num_colours, colours[patch] + 1);
  }
}

}  // namespace buckens::loads
