// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/smooth_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"

namespace buckens::mesh_io {

namespace {

// Relative changes of an area and of the volume beyond which the smooth face is another one.
constexpr double kSameArea = 0.01, kSameVolume = 1e-3;

// Along each parameter: a filled surface through nine points follows a slight bulge; more in the
// middle change little, and those at an edge may lie where the face is folded.
constexpr int kFillPoints = 3;

constexpr const char* kNoSmoothFace = " folds at an edge, and a smooth one through";
constexpr const char* kFoldRemedy =
    ". Delete this face in the CAD program and rebuild it from its edges by a fill or loft";

using FacePoints = std::map<int, std::vector<std::array<double, 3>>>;
using Shells = std::vector<std::vector<int>>;

std::vector<int> numbers_of(const std::vector<GmshEntity>& entities) {
  std::vector<int> out;
  for (const GmshEntity& entity : entities) out.push_back(std::abs(entity.second));
  return out;
}

/// Curves around a face without holes and seams, in any order; empty: it has such.
std::vector<int> one_loop(const GmshLibrary& gmsh, int face) {
  const std::vector<int> curves = numbers_of(gmsh.boundary_of_each({{2, face}}));
  std::map<int, std::vector<int>> curves_at;
  for (const int curve : curves) {
    for (const int point : numbers_of(gmsh.boundary_of_each({{1, curve}}))) {
      curves_at[point].push_back(curve);
    }
  }
  if (std::set<int>(curves.begin(), curves.end()).size() != curves.size()) return {};
  if (curves_at.size() != curves.size()) return {};
  // From curve to curve all are reached.
  std::set<int> reached, waiting = {curves.front()};
  while (!waiting.empty()) {
    const int curve = *waiting.begin();
    waiting.erase(waiting.begin());
    reached.insert(curve);
    for (const auto& [point, at] : curves_at) {
      if (at.size() != 2) return {};
      const bool touches = at[0] == curve || at[1] == curve;
      for (const int next : at) {
        if (touches && !reached.contains(next)) waiting.insert(next);
      }
    }
  }
  return reached.size() == curves.size() ? curves : std::vector<int>();
}

/// The faces of a solid, those that hang together in one list, the largest box first.
Shells shells_of(const GmshLibrary& gmsh, const GmshEntity& solid) {
  std::map<int, std::vector<int>> faces_at;  // by curve
  const std::vector<int> faces = numbers_of(gmsh.boundary_of_each({solid}));
  std::map<int, std::vector<int>> curves;
  for (const int face : faces) {
    curves[face] = numbers_of(gmsh.boundary_of_each({{2, face}}));
    for (const int curve : curves[face]) faces_at[curve].push_back(face);
  }
  Shells out;
  std::set<int> left(faces.begin(), faces.end());
  while (!left.empty()) {
    std::vector<int> own = {*left.begin()};
    left.erase(left.begin());
    for (std::size_t k = 0; k < own.size(); ++k) {
      for (const int curve : curves[own[k]]) {
        for (const int next : faces_at[curve]) {
          if (left.erase(next) > 0) own.push_back(next);
        }
      }
    }
    out.push_back(std::move(own));
  }
  const auto width = [&](const std::vector<int>& shell) {
    std::array<double, 6> all = gmsh.box({2, shell.front()});
    for (const int face : shell) {
      const auto box = gmsh.box({2, face});
      for (std::size_t k = 0; k < 3; ++k) {
        all[k] = std::min(all[k], box[k]);
        all[k + 3] = std::max(all[k + 3], box[k + 3]);
      }
    }
    return std::hypot(all[3] - all[0], all[4] - all[1], all[5] - all[2]);
  };
  std::sort(out.begin(), out.end(),
            [&](const auto& a, const auto& b) { return width(a) > width(b); });
  return out;
}

}  // namespace

std::vector<int> folded_faces(const GmshLibrary& gmsh) {
  std::vector<int> out;
  for (const std::string& line : gmsh.messages()) {
    int count = 0, face = 0;
    const bool is_one =
        std::sscanf(line.c_str(), "Warning: %d elements remain invalid in surface %d", &count,
                    &face) == 2;
    if (is_one) out.push_back(face);
  }
  return out;
}

std::string smooth_folded_faces(GmshLibrary& gmsh, const std::vector<int>& faces, double metre) {
  const auto solids = gmsh.entities(3);
  if (faces.empty() || solids.size() != 1) return {};
  const double volume = std::abs(gmsh.size(solids[0]));
  std::map<int, std::vector<int>> loops;
  std::map<int, double> areas;
  for (const int face : faces) {
    loops[face] = one_loop(gmsh, face);
    if (loops[face].empty()) return {};
    areas[face] = std::abs(gmsh.size({2, face}));
  }
  FacePoints points;
  for (const int face : faces) points[face] = gmsh.inner_points(face, kFillPoints);
  const Shells shells = shells_of(gmsh, solids[0]);
  gmsh.clear_mesh();
  const auto problem = [&]() -> std::string {
    for (const int face : faces) {
      const double area = std::abs(gmsh.size({2, face}));
      if (std::abs(area - areas[face]) <= kSameArea * areas[face]) continue;
      return fmt::format("has {:.2g} % of its area", 100 * area / areas[face]);
    }
    const double change = std::abs(gmsh.size(solids[0])) / volume - 1;
    if (std::abs(change) <= kSameVolume) return "";
    return fmt::format("changes the volume by {:+.2g} %", 100 * change);
  };
  // Without points first: that is the smoothest, and a face that only folds is met by it exactly.
  gmsh.replace_faces(solids[0], shells, loops, {});
  const bool bulges = !problem().empty();
  if (bulges) gmsh.replace_faces(solids[0], shells, loops, points);
  if (const std::string left = problem(); !left.empty()) {
    const auto box = gmsh.box({2, faces[0]});
    throw IoError(fmt::format(
        "face {} around ({:.4g}, {:.4g}, {:.4g}) m{} the same edges and {} of "
        "its points {}{}",
        faces[0], (box[0] + box[3]) / 2 / metre, (box[1] + box[4]) / 2 / metre,
        (box[2] + box[5]) / 2 / metre, kNoSmoothFace, points[faces[0]].size(), left, kFoldRemedy));
  }
  const char* const through = bulges ? "edges and some of its points" : "edges";
  if (faces.size() == 1) {
    return fmt::format(
        "note the surface of face {} folds at an edge and was replaced by a smooth one through the "
        "same {}\n",
        faces[0], through);
  }
  return fmt::format(
      "note the surfaces of {} faces fold at an edge (faces {}): smooth ones through the same {} "
      "were put in their place\n",
      faces.size(), fmt::join(faces, ", "), through);
}

bool is_stopped_by_fold(const std::string& outcome) {
  return outcome.find(kNoSmoothFace) != std::string::npos;
}

}  // namespace buckens::mesh_io
