// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "buckens/loads/box_tree.h"
#include "buckens/loads/pose_memory.h"

namespace buckens::loads {

/// The box around a box of the second body, in axes of the first.
inline Eigen::AlignedBox3d seen_from_first(const RelativePose& pose,
                                           const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d middle = pose.r + pose.R * box.center();
  const Eigen::Vector3d half = pose.R.cwiseAbs() * (0.5 * box.sizes());
  return {middle - half, middle + half};
}

/// Boxes of some of many things. @param numbers of these
inline std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<Eigen::AlignedBox3d>& all,
                                                 const std::vector<int>& numbers) {
  std::vector<Eigen::AlignedBox3d> out;
  for (const int k : numbers) out.push_back(all[static_cast<std::size_t>(k)]);
  return out;
}

/// Distance of a box from the nearest of many [m]. @param enough what is nearer need not be known
/// exactly
inline double distance_to_nearest(const BoxTree& tree, std::span<const Eigen::AlignedBox3d> items,
                                  const Eigen::AlignedBox3d& box, double enough) {
  double best = HUGE_VAL;
  tree.search([&](const Eigen::AlignedBox3d& node) { return node.squaredExteriorDistance(box); },
              [&](double square, std::uint32_t /*marks*/) {
                return square < best && best > enough * enough;
              },
              [&](int k) {
                best =
                    std::min(best, items[static_cast<std::size_t>(k)].squaredExteriorDistance(box));
              });
  return std::sqrt(best);
}

}  // namespace buckens::loads
