// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/box_mesh.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

using Eigen::Vector3d;

std::vector<NamedGridPlace> named_places(const Box& box) {
  const std::array<int, 3>& n = box.divisions;
  std::vector<NamedGridPlace> out = {{"node_first", {0, 0, 0}}, {"node_last", n}};
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> end = {corner / 4, corner / 2 % 2, corner % 2};
    out.push_back({fmt::format("corner_{}{}{}", end[0], end[1], end[2]),
                   {end[0] * n[0], end[1] * n[1], end[2] * n[2]}});
  }
  const std::array<int, 3> middle = {n[0] / 2, n[1] / 2, n[2] / 2};
  const auto is_even = [&](std::size_t axis) { return n[axis] % 2 == 0; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!is_even((axis + 1) % 3) || !is_even((axis + 2) % 3)) continue;
    for (const int end : {0, 1}) {
      std::array<int, 3> place = middle;
      place[axis] = end * n[axis];
      out.push_back({fmt::format("face_{}{}", "xyz"[axis], end), place});
    }
  }
  if (is_even(0) && is_even(1) && is_even(2)) out.push_back({"centre", middle});
  return out;
}

int add_box(Structure& structure, const Box& box, const Material& material) {
  const auto [nx, ny, nz] = box.divisions;
  if (!(box.size.minCoeff() > 0.0) || std::min({nx, ny, nz}) < 1) {
    throw ModelError(
        fmt::format("box of {:g} × {:g} × {:g} m in {} × {} × {} elements: all must be "
                    "positive",
                    box.size.x(), box.size.y(), box.size.z(), nx, ny, nz));
  }
  const int first = static_cast<int>(structure.nodes.size());
  const Vector3d edge(box.size.x() / nx, box.size.y() / ny, box.size.z() / nz);
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        structure.nodes.push_back({"", box.from + edge.cwiseProduct(Vector3d(i, j, k))});
      }
    }
  }
  const int number = structure.solids.add_material(material);
  const auto at = [&](int i, int j, int k) { return first + box.node({i, j, k}); };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        structure.solids.add(
            {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
             at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)},
            number);
      }
    }
  }
  return first;
}

}  // namespace buckens::fem
