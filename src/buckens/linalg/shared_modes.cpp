// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/shared_modes.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

InversePairs shared_pairs(void* factor, const DividedPencil& of) {
  InversePairs out;
  out.theta.resize(of.count);
  out.shapes.resize(of.M->rows(), of.count);
  const SharedRowOrder order = of.M->row_order();
  Matrix motions = *of.motions;
  if (order) {
    for (auto motion : motions.colwise()) {
      const std::vector<double> by_rows = order->by_rows(motion.data());
      std::copy(by_rows.begin(), by_rows.end(), motion.begin());
    }
  }
  BuckensGridModes modes{};
  modes.stiffness = of.K->divide(order).number();
  modes.mass = of.M->divide(order).number();
  modes.shift = of.shift;
  modes.tolerance = of.tolerance;
  modes.count = of.count;
  modes.num_motions = static_cast<int>(motions.cols());
  modes.motions = motions.data();
  modes.theta = out.theta.data();
  modes.shapes = out.shapes.data();
  std::array<char, 400> error{};
  int failure = 0;
  {
    const std::scoped_lock lock(turn_of_grid_solver());
    PutOffWork::finish();
    const SingleThread single;
    failure =
        grid_solver().find_modes(factor, &modes, error.data(), static_cast<int>(error.size()));
  }
  if (failure != 0) {
    throw NumericalError(
        fmt::format("the search for {} modes of {} variables on {} processes failed: {}; ask for "
                    "fewer modes, use more memory, or take the method subspace",
                    of.count, of.M->rows(), Ranks::count(), error.data()));
  }
  out.sweeps = modes.restarts;
  out.solves = modes.solves;
  out.is_complete = modes.found == of.count;
  out.theta.conservativeResize(modes.found);
  out.shapes.conservativeResize(Eigen::NoChange, modes.found);
  if (order) {
    for (auto shape : out.shapes.colwise()) {
      const std::vector<double> by_rows(shape.begin(), shape.end());
      order->by_variables(by_rows, shape.data());
    }
  }
  return out;
}

}  // namespace buckens::linalg
