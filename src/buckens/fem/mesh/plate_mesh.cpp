// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/plate_mesh.h"

#include <utility>

namespace buckens::fem {

namespace {

/// Named places of the grid, counted in half fields.
struct GridName {
  const char* name;
  std::array<int, 2> half;  // 0, 1, 2: beginning, middle, end
};
constexpr std::array<GridName, 9> kNames = {{{"corner_00", {0, 0}},
                                             {"corner_10", {2, 0}},
                                             {"corner_01", {0, 2}},
                                             {"corner_11", {2, 2}},
                                             {"edge_x0", {0, 1}},
                                             {"edge_x1", {2, 1}},
                                             {"edge_y0", {1, 0}},
                                             {"edge_y1", {1, 2}},
                                             {"centre", {1, 1}}}};

bool is_node(const GridName& place, const std::array<int, 2>& divisions) {
  return place.half[0] * divisions[0] % 2 == 0 && place.half[1] * divisions[1] % 2 == 0;
}

}  // namespace

std::vector<std::string> plate_node_names(const std::array<int, 2>& divisions) {
  std::vector<std::string> out;
  for (const GridName& place : kNames) {
    if (is_node(place, divisions)) out.emplace_back(place.name);
  }
  return out;
}

GeneratedMesh add_plate(Structure& structure, const PlateMeshSpec& spec,
                        const ShellSection& section) {
  const auto [nx, ny] = spec.divisions;
  GeneratedMesh out{static_cast<int>(structure.nodes.size()), {}};
  const auto node = [&, columns = nx + 1](int i, int j) {
    return out.first_node + j * columns + i;
  };
  std::array<NodeSet, 4> edges = {NodeSet{"x0", {}}, {"x1", {}}, {"y0", {}}, {"y1", {}}};
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const Eigen::Vector3d place(spec.size[0] * i / nx, spec.size[1] * j / ny, 0.0);
      structure.nodes.push_back({"", spec.from + place});
      if (i == 0) edges[0].nodes.push_back(node(i, j));
      if (i == nx) edges[1].nodes.push_back(node(i, j));
      if (j == 0) edges[2].nodes.push_back(node(i, j));
      if (j == ny) edges[3].nodes.push_back(node(i, j));
    }
  }
  for (NodeSet& edge : edges) structure.node_sets.push_back(std::move(edge));
  const int number = structure.shells.add_section(section);
  const int first = structure.shells.num_elements();
  const auto add = [&](const std::vector<int>& nodes) { structure.shells.add(nodes, number); };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (spec.element == ShellShapeKind::quad4) {
        add({a, b, c, d});
      } else if ((i + j) % 2 == 0) {
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
      }
    }
  }
  FaceSet top{"top", {}, {}}, bottom{"bottom", {}, {}};
  for (int e = first; e < structure.shells.num_elements(); ++e) {
    top.shells.push_back({e, false});
    bottom.shells.push_back({e, true});
  }
  structure.face_sets.push_back(std::move(top));
  structure.face_sets.push_back(std::move(bottom));
  for (const GridName& place : kNames) {
    if (!is_node(place, spec.divisions)) continue;
    out.names.emplace_back(place.name, node(place.half[0] * nx / 2, place.half[1] * ny / 2));
  }
  return out;
}

}  // namespace buckens::fem
