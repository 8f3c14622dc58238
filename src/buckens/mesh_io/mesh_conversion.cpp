// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/mesh_conversion.h"

#include <fmt/format.h>

namespace buckens::mesh_io {

namespace {

std::vector<std::uint8_t> members(const std::vector<int>& set, std::size_t count) {
  std::vector<std::uint8_t> out(count, 0);
  for (const int member : set) out[static_cast<std::size_t>(member)] = 1;
  return out;
}

}  // namespace

VtuGrid vtu_grid(const fem::ImportedMesh& mesh) {
  VtuGrid out;
  out.points = mesh.positions;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> properties;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    const auto count = static_cast<std::size_t>(fem::num_nodes(block.kind));
    for (std::size_t e = 0; e < block.ids.size(); ++e) {
      out.add_cell(block.kind, std::span(block.nodes).subspan(e * count, count));
      ids.push_back(block.ids[e]);
      properties.push_back(block.property);
    }
  }
  out.point_data.push_back({"node", 1, mesh.node_ids, {}});
  for (const auto& set : mesh.node_sets) {
    out.point_data.push_back({"set " + set.name, 1, members(set.nodes, out.points.size()), {}});
  }
  out.cell_data.push_back({"element", 1, std::move(ids), {}});
  out.cell_data.push_back({"property", 1, std::move(properties), {}});
  for (const auto& set : mesh.element_sets) {
    out.cell_data.push_back({"set " + set.name, 1, members(set.elements, out.types.size()), {}});
  }
  return out;
}

std::vector<fem::ImportNote> losses_in_vtu(const fem::ImportedMesh& mesh) {
  std::vector<fem::ImportNote> out;
  const auto note = [&](const char* what, std::size_t count) {
    if (count == 0) return;
    out.push_back({fmt::format("{} cannot be stored in a .vtu file and are left out", what), 0,
                   static_cast<int>(count)});
  };
  note("constants of materials", mesh.materials.size());
  note("sets of faces", mesh.face_sets.size());
  note("point masses", mesh.masses.size());
  note("springs", mesh.springs.size());
  note("links and equations between nodes",
       mesh.rigid_links.size() + mesh.averages.size() + mesh.equations.size());
  return out;
}

}  // namespace buckens::mesh_io
