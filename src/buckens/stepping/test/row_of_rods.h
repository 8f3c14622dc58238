// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "buckens/dynamics/test/example_models.h"

namespace buckens::test {

/// Short steel rods in a row, as a divided beam has them.
inline BeamConstants short_steel_rod() {
  BeamConstants rod;
  rod.L = 0.01;
  rod.rhoA = 2.5;
  rod.EA = 6e7;
  rod.EIy = rod.EIz = 1600;
  rod.GJ = 1200;
  rod.beta = 1e-7;
  rod.elements = 1;
  return rod;
}

/// Such rods fixed to each other, the first on a hinge or a ball joint.
/// @param last_stiffness of the last one, relative to the others
/// @param add what else belongs to the mechanism, of which it gets the rods
inline model::Model row_of_rods(
    int count, std::optional<spatial::Plane> plane, double last_stiffness = 1.0,
    const std::function<void(Mechanism&, const std::vector<int>&)>& add = {}) {
  Mechanism m(plane);
  m.set_gravity({0, -9.81, 0});
  BeamConstants rod = short_steel_rod();
  m.set_length(count * rod.L);
  std::vector<int> rods;
  for (int k = 0; k < count; ++k) {
    if (k + 1 == count) rod.EIz *= last_stiffness;
    const int body = m.add_flexible(straight_beam(rod, plane), {},
                                    {{k * rod.L, 0, 0}, Eigen::Quaterniond::Identity()});
    if (k == 0) {
      m.add_joint(plane ? joints::JointType::revolute : joints::JointType::spherical,
                  Mechanism::ground({0, 0, 0}), m.node_marker(body, 0));
    } else {
      m.add_joint(joints::JointType::fixed, m.node_marker(rods.back(), 1), m.node_marker(body, 0));
    }
    rods.push_back(body);
  }
  if (add) add(m, rods);
  return m.take();
}

}  // namespace buckens::test
