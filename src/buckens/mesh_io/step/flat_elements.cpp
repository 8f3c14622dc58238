// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/flat_elements.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/step/surface.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

// Six volumes as a share of the cube around. A body refuses elements below an eighth of this; what
// is thicker is left as it is, since swapped edges can make thin walls stiffer.
constexpr double kFlatShare = 1e-12;

}  // namespace

std::vector<std::size_t> tetrahedra_without_volume(const PartMesh& mesh) {
  std::vector<std::size_t> out;
  const auto& nodes = mesh.tetrahedra;
  for (std::size_t k = 0; k + 3 < nodes.size(); k += 4) {
    const auto at = [&](std::size_t i) -> const Vector3d& {
      return mesh.positions.at(nodes[k + i]);
    };
    const Vector3d low = at(0).cwiseMin(at(1)).cwiseMin(at(2)).cwiseMin(at(3));
    const Vector3d high = at(0).cwiseMax(at(1)).cwiseMax(at(2)).cwiseMax(at(3));
    const double volumes = std::abs((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)));
    if (!(volumes > kFlatShare * std::pow((high - low).norm(), 3))) out.push_back(k / 4);
  }
  return out;
}

std::string mend_flat_elements(GmshLibrary& gmsh, double metre) {
  PartMesh mesh = part_mesh(gmsh);
  std::vector<std::size_t> flat = tetrahedra_without_volume(mesh);
  for (const char* way : {"", "Netgen", "Relocate3D"}) {
    if (flat.empty()) return {};
    gmsh.optimize(way);
    mesh = part_mesh(gmsh);
    flat = tetrahedra_without_volume(mesh);
  }
  if (flat.empty()) return {};
  const Vector3d place = mesh.positions.at(mesh.tetrahedra[4 * flat.front()]) / metre;
  return fmt::format("{} elements have no volume, the first near ({:.4g}, {:.4g}, {:.4g}) m",
                     flat.size(), place[0], place[1], place[2]);
}

}  // namespace buckens::mesh_io
