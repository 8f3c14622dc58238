// SPDX-License-Identifier: Apache-2.0
// What the inertia of a body does with its rows.
#include <algorithm>
#include <array>

#include "buckens/linalg/row_worker.h"

namespace buckens::linalg {

void RowWorker::do_inertia(RowTask task, const Space& space, Take& take, RowPeers& peers) {
  switch (task) {
    case RowTask::multiply_mass:
      return multiply_mass(space, take, peers);
    case RowTask::couple:
      return couple(space, take, peers);
    case RowTask::moments:
    case RowTask::resultants: {
      const double* x = at(take.next<int>());
      sums_.resize(sums_.size() + kMomentSums, 0.0);
      double* const sums = sums_.data() + sums_.size() - kMomentSums;
      return task == RowTask::moments ? space.inertia->add_moments(x, sums)
                                      : space.inertia->add_resultants(x, sums);
    }
    default: {
      double* y = at(take.next<int>());
      std::array<double, kMotionNumbers> motion{};
      take.take_all(motion.data(), motion.size());
      return task == RowTask::subtract ? space.inertia->subtract(motion.data(), y)
                                       : space.inertia->subtract_load(motion.data(), y);
    }
  }
}

void RowWorker::multiply_mass(const Space& space, Take& take, RowPeers& peers) {
  double* y = make_room(space, take.next<int>());
  double* x = at(take.next<int>());
  fill_beside(space, {x}, peers);
  space.inertia->multiply_mass(x, y);
}

void RowWorker::couple(const Space& space, Take& take, RowPeers& peers) {
  const auto load = take.next<int>();
  std::array<double*, 3> vectors{};
  for (double*& x : vectors) x = at(take.next<int>());
  std::array<double, kCoupleWeights> weights{};
  take.take_all(weights.data(), weights.size());
  fill_beside(space, {vectors[0], vectors[1]}, peers);
  double* to = nullptr;
  if (load >= 0) {
    to = make_room(space, load);
    std::fill_n(to, space.rows(), 0.0);
  }
  NodeSums sums;
  space.inertia->couple({vectors[0], vectors[1], vectors[2]}, weights.data(), to, sums);
  sums_.insert(sums_.end(), sums.value, sums.value + kCoupleSums);
}

}  // namespace buckens::linalg
