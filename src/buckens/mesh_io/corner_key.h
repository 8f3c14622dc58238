// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

/// Corners of a face, an edge or an element, sorted; −1 fills up.
using CornerKey = std::array<int, 8>;

struct CornerHash {
  std::size_t operator()(const CornerKey& key) const {
    std::uint64_t out = 1469598103934665603U;
    for (const int corner : key) {
      out = (out ^ static_cast<std::uint32_t>(corner)) * 1099511628211U;
      out ^= out >> 29;
    }
    return out;
  }
};

template <class Corners>
CornerKey corner_key(const Corners& corners) {
  CornerKey out;
  out.fill(-1);
  std::copy(corners.begin(), corners.end(), out.begin());
  std::sort(out.begin(), out.end());
  return out;
}

inline std::vector<int> nodes_of(const TaggedCells& cells, std::size_t element, int count) {
  const auto first =
      cells.nodes.begin() + static_cast<std::ptrdiff_t>(element) * fem::num_nodes(cells.kind);
  return {first, first + count};
}

inline CornerKey corner_key(const TaggedCells& cells, std::size_t element) {
  return corner_key(nodes_of(cells, element, fem::num_corners(cells.kind)));
}

}  // namespace buckens::mesh_io
