// SPDX-License-Identifier: Apache-2.0
// The matrix of a monolithic step: what stays within the step, and what each iteration adds.
#include <utility>

#include "verification/monolithic/part.h"

namespace buckens::verification {

using Eigen::MatrixXd;
using linalg::SparseMatrix;
using linalg::Triplet;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::vector<MonolithicStepper::Entry> MonolithicStepper::entries(
    const dynamics::SystemRow& row) const {
  std::vector<Entry> out;
  for (const dynamics::BodyRow* share : row.parts()) {
    if (share->body == model::kGround) continue;
    const Part& part = *parts_[static_cast<std::size_t>(share->body)];
    const Eigen::RowVectorXd frame = share->frame * part.basis;
    for (int k = 0; k < static_cast<int>(frame.size()); ++k) {
      out.push_back({part.frame + k, part.frame_correction + k, frame[k]});
    }
    for (int k = 0; k < 6; ++k) {
      const int first = k < 3 ? share->translation_row : share->rotation_row;
      if (first < 0) continue;
      const auto& N = part.body.flexible->rows;
      using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
      for (RowMajor::InnerIterator it(N, first + k % 3); it; ++it) {
        const int dof = static_cast<int>(it.col());
        out.push_back(
            {part.nodal + dof, part.nodal_correction + dof, share->interface[k] * it.value()});
      }
    }
  }
  return out;
}

namespace {

/// Calls f(i, j, share) for all rows that act, the share of what row j alone would give that row i
/// gives: rows that act alone, share 1, and those of mixes.
template <class F>
void for_shares(const dynamics::SoftRows& soft, F&& f) {
  std::size_t mix = 0;
  for (int k = 0; k < static_cast<int>(soft.rows.size()); ++k) {
    if (mix == soft.mixes.size() || soft.first_of_mix[mix] != k) {
      f(k, k, 1.0);
      continue;
    }
    const loads::RowMix& R = soft.mixes[mix++];
    const int count = static_cast<int>(R.rows());
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) f(k + i, k + j, R(i, j));
    }
    k += count - 1;
  }
}

void add_block(std::vector<Triplet>& out, int row, int column, double factor,
               const SparseMatrix& A) {
  for (int k = 0; k < A.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      out.emplace_back(row + static_cast<int>(it.row()), column + static_cast<int>(it.col()),
                       factor * it.value());
    }
  }
}

void add_dense(std::vector<Triplet>& out, int row, int column, const MatrixXd& A) {
  for (int j = 0; j < static_cast<int>(A.cols()); ++j) {
    for (int i = 0; i < static_cast<int>(A.rows()); ++i) {
      out.emplace_back(row + i, column + j, A(i, j));
    }
  }
}

}  // namespace

void MonolithicStepper::fixed_body(const Part& part) {
  add_dense(fixed_, part.frame_correction, part.frame_correction,
            part.basis.transpose() * part.W * part.basis);
  if (!part.is_flexible()) return;
  const body::FlexiblePart& mesh = *part.body.flexible;
  for (const auto& [row, multiplier] :
       {std::pair(part.nodal, part.nodal_multiplier),
        std::pair(part.nodal_correction, part.correction_multiplier)}) {
    add_block(fixed_, row, row, scheme_.mass, mesh.fe.M);
    add_block(fixed_, row, row, scheme_.stiffness, mesh.fe.K);
    if (mesh.is_damped()) add_block(fixed_, row, row, scheme_.damping, mesh.C);
    add_dense(fixed_, row, multiplier, -part.P);
    add_dense(fixed_, multiplier, row, part.P.transpose());
  }
  // Only where the equations hold at the corrected position does its strain count.
  if (scheme_.weight == 1.0) {
    add_block(fixed_, part.nodal, part.nodal_correction, scheme_.stiffness, mesh.fe.K);
  }
}

void MonolithicStepper::add_product(const std::vector<Entry>& row, const std::vector<Entry>& column,
                                    double factor, bool row_corrects, bool column_corrects) {
  for (const Entry& i : row) {
    for (const Entry& j : column) {
      fixed_.emplace_back(row_corrects ? i.correction_column : i.column,
                          column_corrects ? j.correction_column : j.column,
                          factor * i.value * j.value);
    }
  }
}

void MonolithicStepper::fixed_corrections() {
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const int column = first_correction_ + static_cast<int>(k);
    if (!corrects_positions()) {
      fixed_.emplace_back(column, column, 1.0);
      continue;
    }
    const auto row = static_cast<std::size_t>(rows_in_use_[k]);
    for (const Entry& e : entries(predicted_rows_[row])) {
      fixed_.emplace_back(e.correction_column, column, -e.value);
      // A correction of positions rolls as well.
      if (rates_only_[row]) fixed_.emplace_back(column, e.correction_column, e.value);
    }
  }
  for (std::size_t k = 0; k < correcting_.rows.size(); ++k) {
    const double k_eff = scheme_.force * (scheme_.weight * correcting_.stiffness[k] +
                                          scheme_.mean_rate * correcting_.damping[k]);
    const std::vector<Entry> row = entries(correcting_.rows[k]);
    add_product(row, row, k_eff, true, true);
  }
}

void MonolithicStepper::follow_regimes() {
  if (correcting_.regimes == soft_.regimes) return;
  correcting_.regimes = soft_.regimes;
  correcting_.is_closed = soft_.is_closed;
  fixed_part();
}

void MonolithicStepper::fixed_part() {
  fixed_.clear();
  for (const auto& part : parts_) fixed_body(*part);
  fixed_corrections();
  fixed_rigid_corrections();
  fixed_matrix_.resize(size_, size_);
  fixed_matrix_.setFromTriplets(fixed_.begin(), fixed_.end());
}

void MonolithicStepper::tangent(std::vector<Triplet>& out) const {
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    const Matrix6 W = part.metric(scheme_, motions_evaluation_[b].frame.w);
    add_dense(out, part.frame, part.frame, part.basis.transpose() * W * part.basis);
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const auto row = static_cast<std::size_t>(rows_in_use_[k]);
    const int velocity = first_lambda_ + static_cast<int>(k);
    const int position = first_correction_ + static_cast<int>(k);
    for (const Entry& e : entries(evaluation_.rows[row])) {
      out.emplace_back(e.column, velocity, -e.value);
    }
    for (const Entry& e : entries(end_.rows[row])) {
      out.emplace_back(velocity, e.column, e.value);
      if (!corrects_positions() || rates_only_[row]) continue;
      out.emplace_back(position, e.column, e.value);
      out.emplace_back(position, e.correction_column, e.value);
    }
  }
  std::vector<std::vector<Entry>> soft;
  for (const dynamics::SystemRow& row : soft_.rows) soft.push_back(entries(row));
  for_shares(soft_, [&](int on, int by, double share) {
    const auto k = static_cast<std::size_t>(by);
    const double elastic = share * scheme_.force * scheme_.weight * soft_.stiffness[k];
    const double both = elastic + share * scheme_.force * scheme_.mean_rate * soft_.damping[k];
    for (const Entry& i : soft[static_cast<std::size_t>(on)]) {
      for (const Entry& j : soft[k]) {
        out.emplace_back(i.column, j.column, both * i.value * j.value);
        if (scheme_.weight != 1.0) continue;
        out.emplace_back(i.column, j.correction_column, elastic * i.value * j.value);
      }
    }
  });
}

}  // namespace buckens::verification
