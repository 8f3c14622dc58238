// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/fem/assemble.h"
#include "buckens/fem/box_mesh.h"

namespace buckens::bench {

/// Steel block of hex8 elements, 1 × 0.1 × 0.1 m unless said otherwise.
inline fem::FeModel steel_block(const std::array<int, 3>& divisions,
                                const Eigen::Vector3d& size = {1.0, 0.1, 0.1}) {
  fem::Structure structure;
  fem::Box box;
  box.size = size;
  box.divisions = divisions;
  fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850));
  return fem::assemble(structure);
}

/// K̂ of a step of 0.1 ms by average acceleration.
inline linalg::SparseMatrix step_matrix(const fem::FeModel& fe) {
  constexpr double kStep = 1e-4;
  linalg::SparseMatrix out = fe.M + (0.25 * kStep * kStep) * fe.K;
  out.makeCompressed();
  return out;
}

}  // namespace buckens::bench
