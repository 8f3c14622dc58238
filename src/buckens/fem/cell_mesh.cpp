// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/cell_mesh.h"

#include <algorithm>

namespace buckens::fem {

namespace {

using Cell = std::array<int, 27>;
using Place = Eigen::Vector3i;  // of a point in its cell, 0…2 each

int at(const Cell& cell, const Place& p) {
  return cell[static_cast<std::size_t>(p.x() + 3 * p.y() + 9 * p.z())];
}

/// Where the nodes of a hexahedron are in its cell.
Place hexahedron_place(const SolidTopology& topology, int node) {
  const Eigen::Vector3d natural = topology.natural.col(node);
  return (natural + Eigen::Vector3d::Ones()).cast<int>();
}

/// An element as points of its cell, with its faces that are part of the cell's.
struct Part {
  std::vector<int> points;
  std::vector<std::array<int, 2>> faces;  // face of the element, face of the cell
};

std::vector<Part> hexahedron(const Cell& cell, SolidKind kind) {
  const SolidTopology& topology = solid_topology(kind);
  Part out;
  for (int node = 0; node < topology.num_nodes; ++node) {
    out.points.push_back(at(cell, hexahedron_place(topology, node)));
  }
  for (int face = 0; face < 6; ++face) out.faces.push_back({face, face});
  return {out};
}

/// Corners of the six tetrahedra as corners of the hexahedron.
std::vector<std::array<int, 4>> split(const Cell& cell, const SolidTopology& hex) {
  const auto number = [&](int corner) { return at(cell, hexahedron_place(hex, corner)); };
  const auto lower = [&](int a, int b) { return number(a) < number(b); };
  int apex = 0;
  for (int corner = 1; corner < 8; ++corner) apex = std::min(apex, corner, lower);
  std::vector<std::array<int, 4>> out;
  for (const SolidFace& face : hex.faces) {
    const auto& c = face.corners;
    if (std::find(c.begin(), c.end(), apex) != c.end()) continue;
    const auto from =
        static_cast<std::size_t>(std::min_element(c.begin(), c.end(), lower) - c.begin());
    const auto next = [&](std::size_t k) { return c[(from + k) % 4]; };
    // Counter-clockwise seen from outside is clockwise seen from the apex.
    out.push_back({next(0), next(2), next(1), apex});
    out.push_back({next(0), next(3), next(2), apex});
  }
  return out;
}

std::vector<Part> tetrahedra(const Cell& cell, SolidKind kind) {
  const SolidTopology& hex = solid_topology(SolidKind::hex8);
  const SolidTopology& tet = solid_topology(kind);
  std::vector<Part> out;
  for (const auto& corners : split(cell, hex)) {
    Part part;
    const auto place = [&](int k) {
      return hexahedron_place(hex, corners[static_cast<std::size_t>(k)]);
    };
    for (int k = 0; k < 4; ++k) part.points.push_back(at(cell, place(k)));
    for (int node = 4; node < tet.num_nodes; ++node) {
      const auto& [a, b] = tet.edges[static_cast<std::size_t>(node - 4)];
      part.points.push_back(at(cell, (place(a) + place(b)) / 2));
    }
    for (int face = 0; face < 4; ++face) {
      for (int side = 0; side < 6; ++side) {
        const auto& of_side = hex.faces[static_cast<std::size_t>(side)].corners;
        const auto& of_face = tet.faces[static_cast<std::size_t>(face)].corners;
        const bool inside = std::all_of(of_face.begin(), of_face.end(), [&](int k) {
          const int corner = corners[static_cast<std::size_t>(k)];
          return std::find(of_side.begin(), of_side.end(), corner) != of_side.end();
        });
        if (inside) part.faces.push_back({face, side});
      }
    }
    out.push_back(std::move(part));
  }
  return out;
}

/// Faces of the elements on each face of each cell.
class FaceTable {
 public:
  explicit FaceTable(std::size_t cells) : faces_(6 * cells) {}
  std::vector<ElementFace>& of(int cell, int face) {
    return faces_[static_cast<std::size_t>(6 * cell + face)];
  }

 private:
  std::vector<std::vector<ElementFace>> faces_;
};

}  // namespace

bool is_node(SolidKind kind, const std::array<int, 3>& place) {
  const int odd = place[0] % 2 + place[1] % 2 + place[2] % 2;
  return kind == SolidKind::tet10 || odd <= (kind == SolidKind::hex20 ? 1 : 0);
}

GeneratedMesh add_cells(Structure& structure, const CellMesh& mesh, const SolidForm& form,
                        const Material& material) {
  const bool hexahedra = solid_topology(form.kind).is_hexahedron();
  std::vector<std::vector<Part>> parts;
  std::vector<bool> used(mesh.points.size(), false);
  for (const Cell& cell : mesh.cells) {
    parts.push_back(hexahedra ? hexahedron(cell, form.kind) : tetrahedra(cell, form.kind));
    for (const Part& part : parts.back()) {
      for (const int point : part.points) used[static_cast<std::size_t>(point)] = true;
    }
  }
  GeneratedMesh out{static_cast<int>(structure.nodes.size()), {}};
  std::vector<int> node(mesh.points.size(), -1);
  for (std::size_t point = 0; point < node.size(); ++point) {
    if (!used[point]) continue;
    node[point] = static_cast<int>(structure.nodes.size());
    structure.nodes.push_back({"", mesh.points[point]});
  }
  const int number = structure.solids.add_material(material);
  FaceTable table(mesh.cells.size());
  for (std::size_t cell = 0; cell < parts.size(); ++cell) {
    for (Part& part : parts[cell]) {
      for (int& point : part.points) point = node[static_cast<std::size_t>(point)];
      const int element = structure.solids.add(form, part.points, number);
      for (const auto& [face, side] : part.faces) {
        table.of(static_cast<int>(cell), side).push_back({element, face});
      }
    }
  }
  for (const FaceSet& set : mesh.face_sets) {
    FaceSet& own = structure.face_sets.emplace_back(FaceSet{set.name, {}});
    for (const ElementFace& side : set.faces) {
      const auto& faces = table.of(side.element, side.face);
      own.faces.insert(own.faces.end(), faces.begin(), faces.end());
    }
  }
  for (const auto& [name, point] : mesh.names) {
    const int own = node.at(static_cast<std::size_t>(point));
    if (own >= 0) out.names.emplace_back(name, own);
  }
  return out;
}

}  // namespace buckens::fem
