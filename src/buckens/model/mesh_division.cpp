// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/mesh_division.h"

#include <utility>

namespace buckens::model {

MeshDivision divide_mesh(const NamedStructure& whole, const body::FrameDivision& frames) {
  const fem::Structure& structure = whole.structure;
  const int count = frames.of(fem::num_holding_elements(structure));
  fem::StructureParts divided = fem::divide(structure, fem::choose_parts(structure, count));
  MeshDivision out;
  for (fem::Structure& part : divided.parts) {
    out.parts.emplace_back();
    out.parts.back().structure = std::move(part);
  }
  for (std::size_t k = 0; k < whole.places.size(); ++k) {
    const MeshPlace& place = whole.places[k];
    const auto add = [&](const fem::PartPlace& at, bool is_node) {
      NamedStructure& part = out.parts[static_cast<std::size_t>(at.part)];
      part.names.push_back(whole.names[k]);
      part.places.push_back(is_node ? MeshPlace{at.index, -1, 0}
                                    : MeshPlace{-1, at.index, place.xi});
    };
    if (place.node >= 0) {
      for (const auto& copy : divided.nodes[static_cast<std::size_t>(place.node)]) add(copy, true);
    } else {
      add(divided.lines[static_cast<std::size_t>(place.element)], false);
    }
  }
  out.nodes = std::move(divided.nodes);
  out.lines = std::move(divided.lines);
  out.straight_nodes = structure.straight_nodes;
  return out;
}

}  // namespace buckens::model
