// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/faults.h"

#include <set>
#include <vector>

#include <fmt/format.h>

#include "buckens/mesh_io/step/shapes.h"

namespace buckens::mesh_io {

std::string PartFaults::place(const GmshEntity& entity) const {
  const auto box = gmsh_.box(entity);
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", (box[0] + box[3]) / (2 * metre_),
                     (box[1] + box[4]) / (2 * metre_), (box[2] + box[5]) / (2 * metre_));
}

std::string PartFaults::gap() const {
  const auto solids = gmsh_.entities(3);
  const auto faces = gmsh_.entities(2);
  if (faces.empty()) return "error the file has no solid and no faces; export the part as a solid";
  const auto told = [this](const char* sign, const std::vector<GmshEntity>& edges,
                           const char* number) -> std::string {
    if (edges.empty()) return {};
    return fmt::format("{} {} edges belong to {}, the first near {}", sign, edges.size(), number,
                       place(edges.front()));
  };
  if (solids.empty()) {
    const SurfaceFaults faults = surface_faults(gmsh_);
    return fmt::format(
        "open there is no solid, only {} faces{}{}", faces.size(),
        told(":", faults.free, "one face only"),
        told(faults.free.empty() ? ":" : ";", faults.crowded, "three faces or more"));
  }
  std::vector<GmshEntity> free;
  for (const GmshEntity& solid : solids) {
    const auto edges = gmsh_.boundary(gmsh_.boundary({solid}));
    free.insert(free.end(), edges.begin(), edges.end());
  }
  if (free.empty()) return {};
  return "open the surface of the part is not closed" + told(":", free, "one face only");
}

std::string PartFaults::loose_faces() const {
  std::set<GmshEntity> loose;
  for (const GmshEntity& face : gmsh_.entities(2)) loose.insert(face);
  for (const GmshEntity& solid : gmsh_.entities(3)) {
    for (const GmshEntity& face : gmsh_.boundary({solid})) loose.erase(face);
  }
  if (loose.empty()) return {};
  return fmt::format(
      "note {} faces bound no solid and get no elements (walls without thickness?), the first, "
      "face_{}, near {}\n",
      loose.size(), loose.begin()->second, place(*loose.begin()));
}

std::string PartFaults::hinges() const {
  const std::vector<SharedEdge> found = edges_without_faces(gmsh_);
  if (found.empty()) return {};
  return fmt::format(
      "note solids \"{}\" and \"{}\" meet along an edge only, near {}, and could turn about it; "
      "let them share a face or overlap{}\n",
      found.front().first, found.front().second, place({1, found.front().curve}),
      found.size() > 1 ? fmt::format(" ({} such edges)", found.size()) : "");
}

}  // namespace buckens::mesh_io
