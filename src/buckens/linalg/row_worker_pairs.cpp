// SPDX-License-Identifier: Apache-2.0
// What is done with the rows of kept pairs.
#include "buckens/linalg/row_worker.h"

namespace buckens::linalg {

using Eigen::Index;
using Eigen::Map;
using Floats = Map<Eigen::VectorXf>;

void RowWorker::do_pairs(RowTask task, const Space& space, Take& take, RowPeers& peers) {
  const auto n = static_cast<Index>(space.rows());
  const RowPeers::Pairs all = peers.pairs(take.next<int>());
  const auto first = take.next<int>();
  const auto count = take.next<int>();
  const auto load = [&](int k) { return Floats(all.loads + n * (first + k), n); };
  const auto answer = [&](int k) { return Floats(all.answers + n * (first + k), n); };
  switch (task) {
    case RowTask::pair_products: {
      const Map<const Vector> r(at(take.next<int>()), n);
      for (int k = 0; k < count; ++k) sums_.push_back(load(k).cast<double>().dot(r));
      break;
    }
    case RowTask::subtract_loads: {
      Map<Vector> r(at(take.next<int>()), n);
      for (int k = 0; k < count; ++k) r -= take.next<double>() * load(k).cast<double>();
      r = r.cast<float>().cast<double>();
      break;
    }
    case RowTask::combine_answers: {
      Map<Vector> y(make_room(space, take.next<int>()), n);
      if (!take.next<bool>()) y.setZero();
      for (int k = 0; k < count; ++k) y += take.next<double>() * answer(k).cast<double>();
      break;
    }
    default: {
      const auto factor = take.next<double>();
      for (Floats to : {load(0), answer(0)}) {
        to = (factor * Map<const Vector>(at(take.next<int>()), n)).cast<float>();
      }
    }
  }
}

}  // namespace buckens::linalg
