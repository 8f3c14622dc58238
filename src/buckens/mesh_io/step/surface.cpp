// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/surface.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "buckens/mesh_io/step/smooth_faces.h"

namespace buckens::mesh_io {

namespace {

constexpr int kTriangleType = 2, kTetrahedronType = 4;  // Gmsh's types

}  // namespace

PartMesh part_mesh(const GmshLibrary& gmsh) {
  PartMesh out;
  const auto [numbers, places] = gmsh.nodes();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    out.positions[numbers[k]] = Eigen::Vector3d::Map(&places[3 * k]);
  }
  for (const GmshEntity& face : gmsh.entities(2)) {
    out.faces.push_back({face.second, gmsh.element_nodes(kTriangleType, face.second)});
  }
  out.tetrahedra = gmsh.element_nodes(kTetrahedronType, -1);
  return out;
}

MendedSurface mend_surface(GmshLibrary& gmsh, double metre) {
  const PartMesh failed = part_mesh(gmsh);
  const bool has_surface =
      std::all_of(failed.faces.begin(), failed.faces.end(),
                  [](const PartMesh::Face& face) { return !face.triangles.empty(); });
  if (!has_surface) return {};
  auto crossings = surface_crossings(failed);
  if (crossings.empty()) return {};
  MendedSurface out{smooth_folded_faces(gmsh, folded_faces(gmsh), metre), {}};
  if (!out.notes.empty()) {
    gmsh.mesh(2);
    crossings = surface_crossings(part_mesh(gmsh));
  }
  if (!crossings.empty()) {
    const SurfaceCrossing& first = crossings.front();
    const Eigen::Vector3d place = first.place / metre;
    out.crossings = fmt::format(
        "faces cross in {} places, the first ({:.4g}, {:.4g}, {:.4g}) m on faces {} and {}",
        crossings.size(), place[0], place[1], place[2], first.faces[0], first.faces[1]);
  }
  return out;
}

}  // namespace buckens::mesh_io
