// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/ways.h"

#include <algorithm>

namespace buckens::mesh_io {

const std::vector<StepTrial>& step_trials() {
  static const std::vector<StepTrial> trials = {
      {},
      {"faces by another algorithm (MeshAdapt)", false, 1},
      {"in millimetres", true},
      {"with elements that fit the walls", true, 5, 0.9, 0.25},
      {"with smaller elements, on faces by another algorithm (Delaunay)", true, 5, 0.6, 0.15},
      {"with smaller elements, 32 to a turn of curved faces", true, 6, 0.5, 0.02, 32},
      {"after mending edges and small faces", true, 6, 0.7, 0.15, 8, 1e-6},
  };
  return trials;
}

const std::vector<StepTrial>& sewing_trials() {
  static const std::vector<StepTrial> trials = {
      {"sewn", true, 6, 1, 0.25, 8, 1e-6},
      {"sewn", true, 6, 1, 0.25, 8, 1e-5},
      {"sewn", true, 6, 1, 0.25, 8, 1e-4},
      {"sewn", true, 6, 1, 0.25, 8, 4e-4},
  };
  return trials;
}

double chosen_size(double diagonal, double volume, double area) {
  const double wall = area > 0 ? 2 * volume / area : diagonal;
  return std::clamp(2 * wall, diagonal / 30, diagonal / 20);
}

}  // namespace buckens::mesh_io
