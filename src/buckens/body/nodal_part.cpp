// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_part.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace buckens::body {

using Eigen::Index;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Dense products take rows in vectors of up to eight numbers, and the last ones by themselves.
constexpr Index kRowsTogether = 8;

}  // namespace

NodalPart::NodalPart(const NodalRecovery& T, std::vector<int> nodal) {
  if (T.is_identity()) {
    variables_ = std::move(nodal);
  } else if (T.is_dense()) {
    dense_ = &T.dense();
    nodal_ = std::move(nodal);
    variables_.resize(nodal_.empty() ? 0 : static_cast<std::size_t>(dense_->cols()));
    std::iota(variables_.begin(), variables_.end(), 0);
  } else {
    take_rows(T.sparse(), nodal);
  }
}

void NodalPart::take_rows(const SparseMatrix& T, const std::vector<int>& nodal) {
  std::vector<linalg::Triplet> entries;
  for (int column = 0; column < T.outerSize(); ++column) {
    const std::size_t before = entries.size();
    const auto place = static_cast<int>(variables_.size());
    for (SparseMatrix::InnerIterator it(T, column); it; ++it) {
      const auto row = std::lower_bound(nodal.begin(), nodal.end(), static_cast<int>(it.row()));
      if (row == nodal.end() || *row != it.row()) continue;
      entries.emplace_back(static_cast<int>(row - nodal.begin()), place, it.value());
    }
    if (entries.size() > before) variables_.push_back(column);
  }
  rows_.resize(static_cast<Index>(nodal.size()), static_cast<Index>(variables_.size()));
  rows_.setFromTriplets(entries.begin(), entries.end());
}

Vector NodalPart::apply(const Vector& x) const {
  if (dense_ != nullptr) return apply_dense(x);
  if (rows_.rows() == 0) return x;
  return rows_ * x;
}

/// Whole blocks of rows where they are, so that each is the sum that it is in the whole product.
Vector NodalPart::apply_dense(const Vector& x) const {
  Vector out(static_cast<Index>(nodal_.size()));
  Vector block;
  Index first = 0, end = 0;
  for (std::size_t k = 0; k < nodal_.size(); ++k) {
    if (nodal_[k] >= end) {
      first = nodal_[k] / kRowsTogether * kRowsTogether;
      end = std::min(first + kRowsTogether, dense_->rows());
      // Eigen forms the product of a single row in another way.
      if (end - first == 1) first = std::max<Index>(0, first - kRowsTogether);
      block = dense_->middleRows(first, end - first) * x;
    }
    out[static_cast<Index>(k)] = block[nodal_[k] - first];
  }
  return out;
}

}  // namespace buckens::body
