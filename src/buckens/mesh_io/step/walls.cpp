// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/walls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include <Eigen/Geometry>

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

constexpr double kShare = 1.0 / 3;
// A wall of one element: four tetrahedra stand on each triangle of either side and its opposite
// one together, or lie between such.
constexpr double kOnWallTriangle = 1.5;
constexpr double kUnitTriangle = 0.433;  // area of a regular one with sides of length 1
constexpr double kHardlyOther = 0.8;     // a size in place of 1

using Corners = std::array<std::size_t, 3>;

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// What is known of one face.
struct Measured {
  double area = 0, flat_area = 0;
  double walls = 0;  ///< ∫ thickness over the flat area
};

class WallMeasurement {
 public:
  explicit WallMeasurement(const PartMesh& mesh) : mesh_(mesh), measured_(mesh.faces.size()) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& nodes = mesh.faces[f].triangles;
      for (std::size_t k = 0; k + 2 < nodes.size(); k += 3) {
        const Corners corners = {nodes[k], nodes[k + 1], nodes[k + 2]};
        face_of_[sorted(corners)] = f;
        measured_[f].area += area(corners);
        on_surface_.insert(corners.begin(), corners.end());
      }
    }
  }

  std::vector<FlatFace> flat_faces() {
    const auto& nodes = mesh_.tetrahedra;
    for (std::size_t k = 0; k + 3 < nodes.size(); k += 4) {
      for (std::size_t tip = 0; tip < 4; ++tip) {
        take({nodes[k + (tip + 1) % 4], nodes[k + (tip + 2) % 4], nodes[k + (tip + 3) % 4]},
             nodes[k + tip]);
      }
    }
    std::vector<FlatFace> out;
    for (std::size_t f = 0; f < measured_.size(); ++f) {
      const Measured& own = measured_[f];
      if (own.flat_area == 0 || own.flat_area < kShare * own.area) continue;
      out.push_back({mesh_.faces[f].number, own.area, own.walls / own.flat_area});
    }
    return out;
  }

 private:
  const Vector3d& at(std::size_t node) const { return mesh_.positions.at(node); }

  double area(const Corners& c) const {
    return 0.5 * (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0])).norm();
  }

  void take(const Corners& base, std::size_t tip) {
    const auto face = face_of_.find(sorted(base));
    if (face == face_of_.end() || !on_surface_.contains(tip)) return;
    const double own = area(base);
    const Vector3d &a = at(base[0]), &b = at(base[1]), &c = at(base[2]);
    const double height = std::abs((b - a).cross(c - a).dot(at(tip) - a)) / (2 * own);
    // The side of a regular triangle of this area.
    if (std::sqrt(own / kUnitTriangle) < kFlat * height) return;
    Measured& measured = measured_[face->second];
    measured.flat_area += own;
    measured.walls += own * height;
  }

  const PartMesh& mesh_;
  std::vector<Measured> measured_;
  std::map<Corners, std::size_t> face_of_;
  std::unordered_set<std::size_t> on_surface_;
};

}  // namespace

std::vector<FlatFace> flat_faces(const PartMesh& mesh) {
  return WallMeasurement(mesh).flat_faces();
}

std::unordered_map<int, double> sizes_for_walls(const std::vector<FlatFace>& faces, double least,
                                                double size, double most) {
  const auto wanted = [&](const FlatFace& face) {
    return std::clamp(kFlat * face.wall, least, size);
  };
  double elements = 0;
  for (const FlatFace& face : faces) {
    elements += kOnWallTriangle * face.area / (kUnitTriangle * std::pow(wanted(face), 2));
  }
  const double coarser = std::max(1.0, std::sqrt(elements / most));
  std::unordered_map<int, double> out;
  for (const FlatFace& face : faces) {
    const double own = coarser * wanted(face);
    if (own < kHardlyOther * size) out[face.number] = own;
  }
  return out;
}

}  // namespace buckens::mesh_io
