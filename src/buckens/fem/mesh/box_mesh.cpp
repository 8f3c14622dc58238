// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/box_mesh.h"

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

CellMesh box_cells(const Box& box) {
  const auto [nx, ny, nz] = box.divisions;
  if (!(box.size.minCoeff() > 0.0) || std::min({nx, ny, nz}) < 1) {
    throw ModelError(
        fmt::format("box of {:g} × {:g} × {:g} m in {} × {} × {} elements: all must be "
                    "positive",
                    box.size.x(), box.size.y(), box.size.z(), nx, ny, nz));
  }
  CellMesh out;
  const Box fine{box.from, box.size, {2 * nx, 2 * ny, 2 * nz}};
  const Vector3d step(box.size.x() / nx, box.size.y() / ny, box.size.z() / nz);
  for (int k = 0; k <= 2 * nz; ++k) {
    for (int j = 0; j <= 2 * ny; ++j) {
      for (int i = 0; i <= 2 * nx; ++i) {
        out.points.push_back(box.from + step.cwiseProduct(0.5 * Vector3d(i, j, k)));
      }
    }
  }
  for (const char* name : {"x0", "x1", "y0", "y1", "z0", "z1"}) out.face_sets.push_back({name, {}});
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const int cell = static_cast<int>(out.cells.size());
        std::array<int, 27>& points = out.cells.emplace_back();
        for (int p = 0; p < 27; ++p) {
          points[static_cast<std::size_t>(p)] =
              fine.node({2 * i + p % 3, 2 * j + p / 3 % 3, 2 * k + p / 9});
        }
        const std::array<bool, 6> outside = {i == 0,      i == nx - 1, j == 0,
                                             j == ny - 1, k == 0,      k == nz - 1};
        for (std::size_t face = 0; face < 6; ++face) {
          if (outside[face]) out.face_sets[face].faces.push_back({cell, static_cast<int>(face)});
        }
      }
    }
  }
  for (const NamedGridPlace& named : named_places(fine)) {
    out.names.emplace_back(named.name, fine.node(named.place));
  }
  return out;
}

GeneratedMesh add_box(Structure& structure, const Box& box, const Material& material,
                      const SolidForm& form) {
  return add_cells(structure, box_cells(box), form, material);
}

int add_box(Structure& structure, const Box& box, const Material& material) {
  return add_box(structure, box, material, {SolidKind::hex8, SolidIntegration::full}).first_node;
}

}  // namespace buckens::fem
