// SPDX-License-Identifier: Apache-2.0
// The part of MultiplierCondensation that exchanges rows where pivots are poor.
#include "buckens/dynamics/multiplier_condensation.h"

namespace buckens::dynamics {

namespace {
// Up to so many rows a dense matrix is factorised sooner than a sparse one is looked through; up to
// more, if most of it is full, as that of one body on many places is.
constexpr int kMostSmall = 64;
constexpr int kMostFull = 300;
constexpr double kFull = 0.3;
}  // namespace

template <class Take>
void MultiplierCondensation::for_entries(bool may_leave_out, Take&& take) {
  const auto is_idle = [&](int block) { return is_idle_[static_cast<std::size_t>(block)] != 0; };
  for (const auto& [i, j] : couples_) {
    if (may_leave_out && i != j && (is_idle(i) || is_idle(j))) continue;
    const RowBlock& row = force_.blocks()[static_cast<std::size_t>(i)];
    const RowBlock& column = force_.blocks()[static_cast<std::size_t>(j)];
    const int place = block_lu_.place(i, j);
    const double* const S = block_lu_.block(place);
    const int stride = block_lu_.stride(place);
    for (int m = 0; m < column.count; ++m) {
      for (int k = 0; k < row.count; ++k) {
        take(row.rows[static_cast<std::size_t>(k)], column.rows[static_cast<std::size_t>(m)],
             S[m * stride + k]);
      }
    }
  }
}

void MultiplierCondensation::make_general() {
  std::vector<linalg::Triplet> entries;
  for_entries(false,
              [&](int row, int column, double value) { entries.emplace_back(row, column, value); });
  S_.resize(size() - num_loose_, size() - num_loose_);
  S_.setFromTriplets(entries.begin(), entries.end());
  general_.emplace(S_);
}

bool MultiplierCondensation::take_small() {
  rows_of_small_.clear();
  const int rows = size() - num_loose_;
  place_in_small_.assign(static_cast<std::size_t>(rows), -1);
  for (int row = 0; row < rows; ++row) {
    if (is_empty(row)) continue;
    place_in_small_[static_cast<std::size_t>(row)] = static_cast<int>(rows_of_small_.size());
    rows_of_small_.push_back(row);
  }
  const auto count = static_cast<int>(rows_of_small_.size());
  if (count == rows || count > kMostFull) return false;
  small_matrix_.setZero(count, count);
  diagonal_of_empty_.setOnes(rows);
  int num_entries = 0;
  for_entries(true, [&](int row, int column, double value) {
    const int i = place_in_small_[static_cast<std::size_t>(row)];
    const int j = place_in_small_[static_cast<std::size_t>(column)];
    if (row == column && i < 0) diagonal_of_empty_[row] = value;
    if (i < 0 || j < 0) return;
    small_matrix_(i, j) = value;
    ++num_entries;
  });
  return count <= kMostSmall || num_entries > kFull * count * count;
}

bool MultiplierCondensation::factorise_with_exchanges() {
  is_small_ = take_small();
  if (is_small_) return small_.factorise(small_matrix_) && diagonal_of_empty_.minCoeff() > 0.0;
  if (!general_) {
    make_general();
  } else {
    for_entries(false,
                [&](int row, int column, double value) { S_.coeffRef(row, column) = value; });
  }
  return general_->factorise(S_);
}

std::vector<double> MultiplierCondensation::pivoted_values() const {
  return general_ ? general_->pivoted_values() : std::vector<double>{};
}

void MultiplierCondensation::pivot_as(const std::vector<double>& values) {
  if (values.empty()) return;
  block_lu_.clear();
  make_general();
  // Values of other rows say nothing about these.
  if (static_cast<std::size_t>(S_.nonZeros()) != values.size()) return general_.reset();
  std::copy(values.begin(), values.end(), S_.valuePtr());
  general_->factorise(S_);
}

void MultiplierCondensation::solve_with_exchanges(linalg::Vector& x) const {
  if (!is_small_) return general_->solve_in_place(x);
  small_x_.resize(static_cast<Eigen::Index>(rows_of_small_.size()));
  for (std::size_t k = 0; k < rows_of_small_.size(); ++k) {
    small_x_[static_cast<Eigen::Index>(k)] = x[rows_of_small_[k]];
  }
  small_.solve_in_place(small_x_);
  x.array() /= diagonal_of_empty_.array();
  for (std::size_t k = 0; k < rows_of_small_.size(); ++k) {
    x[rows_of_small_[k]] = small_x_[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace buckens::dynamics
