// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_responses.h"

#include <algorithm>

#include "buckens/linalg/content_hash.h"

namespace buckens::stepping {

using Eigen::Index;

namespace {

template <class Sparse>
void add_sparse(linalg::ContentHash& hash, const Sparse& A) {
  const auto bytes = [&](const auto* from, Index count) {
    hash.add(from, sizeof(*from) * static_cast<std::size_t>(count));
  };
  bytes(A.valuePtr(), A.nonZeros());
  bytes(A.innerIndexPtr(), A.nonZeros());
  bytes(A.outerIndexPtr(), A.outerSize() + 1);
}

}  // namespace

BodyResponses::Source::Source(const linalg::Factor* of, const body::NodalMotion* by,
                              const body::FlexiblePart& part, const InterfaceRows& N,
                              const Scheme& scheme)
    : factor(of), motion(by) {
  linalg::ContentHash hash;
  add_sparse(hash, N);
  if (part.is_damped()) {
    for (const std::uint64_t number : part.C.content()) hash.add(number);
  }
  for (const double number : {scheme.mass, scheme.damping, scheme.weight}) {
    hash.add(&number, sizeof number);
  }
  hash.add(static_cast<std::uint64_t>(part.num_interface_rows));
  hash.add(static_cast<std::uint64_t>(part.coupling.may_use_patterns()));
  rest = hash.value();
}

void BodyResponses::add_columns(const linalg::Matrix& columns,
                                const Eigen::Ref<const Eigen::VectorXd>& weights, double factor,
                                Index first, Eigen::Ref<linalg::Vector> piece) {
  constexpr Index kAtOnce = 8;
  const linalg::NodeKernels& kernels = linalg::node_kernels();
  for (Index c = 0; c < weights.size(); c += kAtOnce) {
    std::array<double, kAtOnce> scaled;
    const Index some = std::min(kAtOnce, weights.size() - c);
    for (Index k = 0; k < some; ++k) {
      scaled[static_cast<std::size_t>(k)] = factor * weights[c + k];
    }
    kernels.add_columns(columns.data() + c * columns.rows() + first, columns.rows(),
                        static_cast<int>(some), scaled.data(), piece.size(), piece.data());
  }
}

}  // namespace buckens::stepping
