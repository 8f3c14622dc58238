// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/gmsh/elements.h"

#include <algorithm>

#include "buckens/base/errors.h"

namespace buckens::mesh_io {

using fem::CellKind;

namespace {

/// Those that stand first are what our shapes are written as. Orders of nodes: Gmsh's reference
/// manual, chapter "Node ordering".
const std::vector<GmshElement>& elements() {
  static const std::vector<GmshElement> all = {
      {15, "point", 1, CellKind::point1, {}},
      {1, "line", 2, CellKind::line2, {}},
      {8, "line with 3 nodes", 3, CellKind::line3, {}},
      {2, "triangle", 3, CellKind::tri3, {}},
      {9, "triangle with 6 nodes", 6, CellKind::tri6, {}},
      {3, "quadrangle", 4, CellKind::quad4, {}},
      {16, "quadrangle with 8 nodes", 8, CellKind::quad8, {}},
      {4, "tetrahedron", 4, CellKind::tet4, {}},
      {11, "tetrahedron with 10 nodes", 10, CellKind::tet10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {7, "pyramid", 5, CellKind::pyramid5, {}},
      {6, "prism", 6, CellKind::wedge6, {}},
      {18,
       "prism with 15 nodes",
       15,
       CellKind::wedge15,
       {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
      {5, "hexahedron", 8, CellKind::hex8, {}},
      {17, "hexahedron with 20 nodes", 20, CellKind::hex20, {0,  1,  2,  3,  4,  5,  6,
                                                             7,  8,  11, 13, 9,  16, 18,
                                                             19, 17, 10, 12, 14, 15}},
      {10, "quadrangle with 9 nodes", 9, CellKind::quad8, {0, 1, 2, 3, 4, 5, 6, 7}},
      {13,
       "prism with 18 nodes",
       18,
       CellKind::wedge15,
       {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
      {12, "hexahedron with 27 nodes", 27, CellKind::hex20, {0,  1,  2,  3,  4,  5,  6,
                                                             7,  8,  11, 13, 9,  16, 18,
                                                             19, 17, 10, 12, 14, 15}},
  };
  return all;
}

}  // namespace

const GmshElement* gmsh_element(int type) {
  const auto found = std::find_if(elements().begin(), elements().end(),
                                  [&](const GmshElement& e) { return e.type == type; });
  return found == elements().end() ? nullptr : &*found;
}

const GmshElement& gmsh_element(CellKind kind) {
  const auto found = std::find_if(elements().begin(), elements().end(),
                                  [&](const GmshElement& e) { return e.kind == kind; });
  BUCKENS_ASSERT(found != elements().end());
  return *found;
}

std::string gmsh_element_names() {
  return "lines, triangles, quadrangles, tetrahedra, prisms and hexahedra of first and second "
         "order, and pyramids of first order";
}

}  // namespace buckens::mesh_io
