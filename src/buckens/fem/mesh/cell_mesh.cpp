// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/cell_mesh.h"

#include <algorithm>

namespace buckens::fem {

namespace {

using Cell = std::array<int, 27>;
using CellPoint = Eigen::Vector3i;  // of a point in its cell, 0…2 each

int at(const Cell& cell, const CellPoint& p) {
  return cell[static_cast<std::size_t>(p.x() + 3 * p.y() + 9 * p.z())];
}

/// Where a node of the hexahedron lies in its cell.
CellPoint hexahedron_place(const SolidTopology& topology, int node) {
  const Eigen::Vector3d natural = topology.natural.col(node);
  return (natural + Eigen::Vector3d::Ones()).cast<int>();
}

/// An element as points of its cell, with its faces that are part of the cell's.
struct Part {
  std::vector<int> points;
  std::vector<std::array<int, 2>> faces;  // face of the element, face of the cell
};

/// The element with its corners at the given places of a cell; mid-side nodes lie halfway.
Part make_part(const Cell& cell, SolidKind kind, const std::vector<CellPoint>& corners) {
  const SolidTopology& topology = solid_topology(kind);
  Part out;
  for (const CellPoint& corner : corners) out.points.push_back(at(cell, corner));
  for (int node = topology.num_corners; node < topology.num_nodes; ++node) {
    const auto& [a, b] = topology.edges[static_cast<std::size_t>(node - topology.num_corners)];
    const CellPoint& first = corners[static_cast<std::size_t>(a)];
    out.points.push_back(at(cell, (first + corners[static_cast<std::size_t>(b)]) / 2));
  }
  for (std::size_t face = 0; face < topology.faces.size(); ++face) {
    for (int side = 0; side < 6; ++side) {  // x0, x1, y0, y1, z0, z1
      const auto& own = topology.faces[face].corners;
      const bool inside = std::all_of(own.begin(), own.end(), [&](int k) {
        return corners[static_cast<std::size_t>(k)][side / 2] == 2 * (side % 2);
      });
      if (inside) out.faces.push_back({static_cast<int>(face), side});
    }
  }
  return out;
}

std::vector<Part> hexahedron_parts(const Cell& cell, SolidKind kind) {
  const SolidTopology& hex = solid_topology(SolidKind::hex8);
  std::vector<CellPoint> corners;
  for (int corner = 0; corner < 8; ++corner) corners.push_back(hexahedron_place(hex, corner));
  return {make_part(cell, kind, corners)};
}

/// Two wedges: all cells are cut along the same diagonal of their third axis.
std::vector<Part> wedges(const Cell& cell, SolidKind kind) {
  const SolidTopology& hex = solid_topology(SolidKind::hex8);
  std::vector<Part> out;
  for (const auto& corners : {std::array{0, 1, 2, 4, 5, 6}, std::array{0, 2, 3, 4, 6, 7}}) {
    std::vector<CellPoint> places;
    for (const int corner : corners) places.push_back(hexahedron_place(hex, corner));
    out.push_back(make_part(cell, kind, places));
  }
  return out;
}

/// Six pyramids with their apex in the middle of the cell.
std::vector<Part> pyramids(const Cell& cell, SolidKind kind) {
  const SolidTopology& hex = solid_topology(SolidKind::hex8);
  std::vector<Part> out;
  for (const SolidFace& face : hex.faces) {
    std::vector<CellPoint> places;  // counter-clockwise seen from inside
    for (const std::size_t k : {0, 3, 2, 1}) {
      places.push_back(hexahedron_place(hex, face.corners[k]));
    }
    places.emplace_back(1, 1, 1);
    out.push_back(make_part(cell, kind, places));
  }
  return out;
}

/// Corners of the six tetrahedra as corners of the hexahedron_parts.
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
  std::vector<Part> out;
  for (const auto& corners : split(cell, hex)) {
    std::vector<CellPoint> places;
    for (const int corner : corners) places.push_back(hexahedron_place(hex, corner));
    out.push_back(make_part(cell, kind, places));
  }
  return out;
}

std::vector<Part> parts_of(const Cell& cell, SolidKind kind) {
  switch (solid_topology(kind).num_corners) {
    case 8:
      return hexahedron_parts(cell, kind);
    case 6:
      return wedges(cell, kind);
    case 5:
      return pyramids(cell, kind);
    default:
      return tetrahedra(cell, kind);
  }
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
  switch (kind) {
    case SolidKind::tet10:
      return true;
    case SolidKind::hex20:
      return odd <= 1;
    case SolidKind::wedge15:
      return odd <= 1 || (odd == 2 && place[2] % 2 == 0);
    case SolidKind::pyramid5:
      return odd == 0 || odd == 3;
    default:
      return odd == 0;
  }
}

int elements_per_cell(SolidKind kind) {
  const SolidTopology& topology = solid_topology(kind);
  if (topology.is_hexahedron()) return 1;
  return topology.is_wedge() ? 2 : 6;
}

GeneratedMesh add_cells(Structure& structure, const CellMesh& mesh, const SolidForm& form,
                        const Material& material) {
  std::vector<std::vector<Part>> parts;
  std::vector<bool> used(mesh.points.size(), false);
  for (const Cell& cell : mesh.cells) {
    parts.push_back(parts_of(cell, form.kind));
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
