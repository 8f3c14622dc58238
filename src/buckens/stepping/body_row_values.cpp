// SPDX-License-Identifier: Apache-2.0
// Values along the rows of one body at the start of a step, in one pass over its variables.
#include <algorithm>
#include <array>

#include "buckens/linalg/row_parts.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

using linalg::RowParts;
using linalg::Vector;

namespace {

using Past = std::array<const Vector*, 4>;
using PatternValues = Eigen::Matrix<double, 6, 4>;

PatternValues nodal_values(const body::NodalMotion& motion, const Past& past, TaskPool* pool) {
  const RowParts rows(past[0]->size(), 3);
  std::array<std::array<linalg::NodeSums, 4>, RowParts::kMostParts> sums;
  rows.for_pieces(pool, [&](int part, Eigen::Index first, Eigen::Index size) {
    for (std::size_t k = 0; k < 4; ++k) {
      motion.add_moments(first, size, *past[k], sums[static_cast<std::size_t>(part)][k]);
    }
  });
  PatternValues out = PatternValues::Zero();
  for (int part = 0; part < rows.count(); ++part) {
    for (std::size_t k = 0; k < 4; ++k) {
      out.col(static_cast<Eigen::Index>(k)) +=
          body::NodalMotion::patterns(sums[static_cast<std::size_t>(part)][k]);
    }
  }
  return out;
}

PatternValues dense_values(const linalg::Matrix& patterns, const Past& past, TaskPool* pool) {
  const RowParts rows(past[0]->size());
  std::array<PatternValues, RowParts::kMostParts> sums;
  std::fill_n(sums.begin(), rows.count(), PatternValues::Zero());
  rows.for_pieces(pool, [&](int part, Eigen::Index first, Eigen::Index size) {
    PatternValues& sum = sums[static_cast<std::size_t>(part)];
    const auto piece = patterns.middleRows(first, size).transpose();
    for (std::size_t k = 0; k < 4; ++k) {
      sum.col(static_cast<Eigen::Index>(k)).noalias() += piece * past[k]->segment(first, size);
    }
  });
  PatternValues whole = sums[0];
  for (int part = 1; part < rows.count(); ++part) whole += sums[static_cast<std::size_t>(part)];
  return whole;
}

}  // namespace

void BodyStepOperator::row_values(const model::BodyState& state, Vector& y, Vector& y_dot,
                                  Vector& y_ddot, Vector& y_alg, TaskPool* pool) const {
  if (!small_.empty()) {
    small_.row_values(state.d, y);
    small_.row_values(state.d_dot, y_dot);
    small_.row_values(state.d_ddot, y_ddot);
    small_.row_values(state.d_alg, y_alg);
    return;
  }
  if (divided_) return divided_->row_values(*this, state, y, y_dot, y_ddot, y_alg);
  for (Vector* values : {&y, &y_dot, &y_ddot, &y_alg}) values->setZero(num_rows());
  const Vector &d = state.d.whole(), &d_dot = state.d_dot.whole();
  const Vector &d_ddot = state.d_ddot.whole(), &d_alg = state.d_alg.whole();
  for (int row = 0; row < num_interface_rows(); ++row) {
    double sum = 0, sum_dot = 0, sum_ddot = 0, sum_alg = 0;
    for (InterfaceRows::InnerIterator it(N_, row); it; ++it) {
      sum += it.value() * d[it.col()];
      sum_dot += it.value() * d_dot[it.col()];
      sum_ddot += it.value() * d_ddot[it.col()];
      sum_alg += it.value() * d_alg[it.col()];
    }
    y[row] = sum;
    y_dot[row] = sum_dot;
    y_ddot[row] = sum_ddot;
    y_alg[row] = sum_alg;
  }
  if (has_patterns_ && state.terms.use_patterns()) {
    const Past past = {&d, &d_dot, &d_ddot, &d_alg};
    const PatternValues values =
        nodal_ ? nodal_values(*nodal_, past, pool) : dense_values(stored_patterns(), past, pool);
    y.tail<6>() = values.col(0);
    y_dot.tail<6>() = values.col(1);
    y_ddot.tail<6>() = values.col(2);
    y_alg.tail<6>() = values.col(3);
  }
}

}  // namespace buckens::stepping
