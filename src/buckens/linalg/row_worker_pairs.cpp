// SPDX-License-Identifier: Apache-2.0
// What is done with the rows of kept pairs.
#include <vector>

#include "buckens/linalg/float_columns.h"
#include "buckens/linalg/row_worker.h"

namespace buckens::linalg {

using Eigen::Index;
using Eigen::Map;

void RowWorker::do_pairs(RowTask task, const Space& space, Take& take, RowPeers& peers) {
  const auto n = static_cast<Index>(space.rows());
  const RowPeers::Pairs all = peers.pairs(take.next<int>());
  const auto first = take.next<int>();
  const auto count = take.next<int>();
  const auto columns = [&](const float* of) { return FloatColumns{of + n * first, n, n, count}; };
  std::vector<double> weights(static_cast<std::size_t>(count));
  switch (task) {
    case RowTask::pair_products: {
      const double* r = at(take.next<int>());
      sums_.resize(sums_.size() + static_cast<std::size_t>(count));
      columns(all.loads).products(r, sums_.data() + sums_.size() - count);
      break;
    }
    case RowTask::subtract_loads: {
      Map<Vector> r(at(take.next<int>()), n);
      for (double& weight : weights) weight = take.next<double>();
      columns(all.loads).add_to(-1.0, weights.data(), r.data());
      r = r.cast<float>().cast<double>();
      break;
    }
    case RowTask::combine_answers: {
      Map<Vector> y(make_room(space, take.next<int>()), n);
      if (!take.next<bool>()) y.setZero();
      for (double& weight : weights) weight = take.next<double>();
      columns(all.answers).add_to(1.0, weights.data(), y.data());
      break;
    }
    default: {
      const auto factor = take.next<double>();
      for (float* of : {all.loads, all.answers}) {
        Map<Eigen::VectorXf> to(of + n * first, n);
        to = (factor * Map<const Vector>(at(take.next<int>()), n)).cast<float>();
      }
    }
  }
}

}  // namespace buckens::linalg
