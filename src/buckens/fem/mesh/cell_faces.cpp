// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/cell_faces.h"

namespace buckens::fem {

namespace {

using Edge = std::array<int, 2>;

constexpr std::array<CellFace, 1> kTriangle = {{{0, 1, 2, -1}}};
constexpr std::array<CellFace, 1> kQuadrangle = {{{0, 1, 2, 3}}};
constexpr std::array<CellFace, 4> kTetrahedron = {
    {{1, 2, 3, -1}, {2, 0, 3, -1}, {0, 1, 3, -1}, {0, 2, 1, -1}}};
constexpr std::array<CellFace, 5> kPyramid = {
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
constexpr std::array<CellFace, 5> kWedge = {
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<CellFace, 6> kHexahedron = {
    {{3, 0, 4, 7}, {1, 2, 6, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

constexpr std::array<Edge, 1> kLineEdges = {{{0, 1}}};
constexpr std::array<Edge, 3> kTriangleEdges = {{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Edge, 4> kQuadrangleEdges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Edge, 6> kTetrahedronEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 8> kPyramidEdges = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<Edge, 9> kWedgeEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 12> kHexahedronEdges = {{{0, 1},
                                                    {1, 2},
                                                    {2, 3},
                                                    {3, 0},
                                                    {4, 5},
                                                    {5, 6},
                                                    {6, 7},
                                                    {7, 4},
                                                    {0, 4},
                                                    {1, 5},
                                                    {2, 6},
                                                    {3, 7}}};

}  // namespace

int num_corners(CellKind kind) {
  constexpr std::array<int, 14> counts = {1, 2, 2, 3, 3, 4, 4, 4, 4, 5, 6, 6, 8, 8};
  return counts[static_cast<std::size_t>(kind)];
}

std::span<const CellFace> cell_faces(CellKind kind) {
  switch (num_corners(kind)) {
    case 3:
      return kTriangle;
    case 4:
      if (dimension_of(kind) == 2) return kQuadrangle;
      return kTetrahedron;
    case 5:
      return kPyramid;
    case 6:
      return kWedge;
    case 8:
      return kHexahedron;
    default:
      return {};
  }
}

std::span<const std::array<int, 2>> cell_edges(CellKind kind) {
  switch (num_corners(kind)) {
    case 2:
      return kLineEdges;
    case 3:
      return kTriangleEdges;
    case 4:
      if (dimension_of(kind) == 2) return kQuadrangleEdges;
      return kTetrahedronEdges;
    case 5:
      return kPyramidEdges;
    case 6:
      return kWedgeEdges;
    case 8:
      return kHexahedronEdges;
    default:
      return {};
  }
}

}  // namespace buckens::fem
