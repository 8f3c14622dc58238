// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/plate_mesh.h"

#include <algorithm>
#include <map>
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

/// The nodes on the sides of elements, each once.
class MidSides {
 public:
  explicit MidSides(Structure& structure) : structure_(structure) {}

  /// Adds the nodes on the sides of an element behind its corners.
  void append(std::vector<int>& corners) {
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int a = corners[k], b = corners[(k + 1) % count];
      const auto [known, is_new] =
          between_.try_emplace(std::minmax(a, b), static_cast<int>(structure_.nodes.size()));
      if (is_new) structure_.nodes.push_back({"", 0.5 * (place(a) + place(b))});
      corners.push_back(known->second);
    }
  }

  /// Adds to corners that follow one another along a line the nodes between them.
  void add_between(std::vector<int>& corners) const {
    const std::size_t count = corners.size();
    for (std::size_t k = 1; k < count; ++k) {
      const auto found = between_.find(std::minmax(corners[k - 1], corners[k]));
      if (found != between_.end()) corners.push_back(found->second);
    }
  }

 private:
  const Eigen::Vector3d& place(int node) const {
    return structure_.nodes[static_cast<std::size_t>(node)].position;
  }

  Structure& structure_;
  std::map<std::pair<int, int>, int> between_;
};

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
  const int number = structure.shells.add_section(section);
  const int first = structure.shells.num_elements();
  MidSides mid_sides(structure);
  const auto add = [&](std::vector<int> nodes) {
    if (is_quadratic(spec.element)) mid_sides.append(nodes);
    structure.shells.add(nodes, number);
  };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (spec.element == ShellShapeKind::quad4 || spec.element == ShellShapeKind::quad8) {
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
  for (NodeSet& edge : edges) {
    mid_sides.add_between(edge.nodes);
    structure.node_sets.push_back(std::move(edge));
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
