// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/flat_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

// Of the size of an element: less is rounding of its coordinates.
constexpr double kLeavesPlane = 1e-6;

}  // namespace

void require_flat(const std::string& body, const SourceLocation& where,
                  const fem::Structure& structure, const Vector3d& normal) {
  const auto check = [&](const fem::ElementBlock& block, const char* what) {
    for (int e = 0; e < block.num_elements(); ++e) {
      double least = HUGE_VAL, most = -HUGE_VAL;
      Eigen::AlignedBox3d box;
      for (const int node : block.nodes(e)) {
        const Vector3d& p = structure.nodes[static_cast<std::size_t>(node)].position;
        least = std::min(least, normal.dot(p));
        most = std::max(most, normal.dot(p));
        box.extend(p);
      }
      if (most - least <= kLeavesPlane * box.diagonal().norm()) continue;
      throw InputError(where,
                       fmt::format("body \"{}\": {} {} between ({:g}, {:g}, {:g}) and ({:g}, {:g}, "
                                   "{:g}) m leaves the plane of the planar model by {:.4g} m; "
                                   "place it parallel to the plane, or remove `planar`",
                                   body, what, e + 1, box.min().x(), box.min().y(), box.min().z(),
                                   box.max().x(), box.max().y(), box.max().z(), most - least));
    }
  };
  check(structure.beams, "beam element");
  check(structure.bars, "bar element");
  check(structure.shells, "shell element");
}

}  // namespace buckens::model
