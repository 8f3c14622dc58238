// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/element_recovery.h"

#include <algorithm>
#include <utility>

#include "buckens/fem/assembly/stress_rows.h"
#include "buckens/fem/solid/recovery.h"

namespace buckens::fem {

using Rows = linalg::SparseRows::RowMajor;

namespace {

void list_columns(const Rows& A, std::vector<int>& columns) {
  columns.insert(columns.end(), A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

/// Only these columns, which are all that have entries.
Rows with_columns(const std::vector<int>& columns, const Rows& A) {
  std::vector<linalg::Triplet> entries;
  for (int row = 0; row < A.outerSize(); ++row) {
    for (Rows::InnerIterator it(A, row); it; ++it) {
      const auto found = std::lower_bound(columns.begin(), columns.end(), it.col());
      entries.emplace_back(row, static_cast<int>(found - columns.begin()), it.value());
    }
  }
  Rows out(A.rows(), static_cast<Eigen::Index>(columns.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Solids are numbered before shells.
int first_shell_of(const FeModel& fe) {
  int solids = 0;
  for (const auto& block : fe.blocks) solids += block->is_solid() ? block->num_elements() : 0;
  return solids;
}

}  // namespace

ElementRecovery::ElementRecovery(const FeModel& fe, const Recovery& lines,
                                 std::vector<int> of_lines, const std::vector<int>& of_solids)
    : lines_(&lines),
      of_lines_(std::move(of_lines)),
      force_rows_(lines.rows_of(of_lines_)),
      stress_rows_(stress_rows_of(fe.blocks, {fe.nodes, fe.dofs}, of_solids)) {
  const auto first_shell = std::lower_bound(of_solids.begin(), of_solids.end(), first_shell_of(fe));
  num_solids_ = first_shell - of_solids.begin();
  num_shells_ = of_solids.end() - first_shell;
  for (const Rows* rows : {&force_rows_, &stress_rows_}) list_columns(*rows, variables_);
  for (Rows* rows : {&force_rows_, &stress_rows_}) *rows = with_columns(variables_, *rows);
}

linalg::Matrix ElementRecovery::section_forces(const linalg::Vector& d) const {
  linalg::Matrix forces(12, static_cast<Eigen::Index>(of_lines_.size()));
  forces.reshaped().noalias() = force_rows_ * d;
  return forces;
}

linalg::Matrix ElementRecovery::stresses(const linalg::Matrix& section_forces) const {
  return lines_->stresses(section_forces, of_lines_);
}

linalg::Matrix ElementRecovery::solid_stresses(const linalg::Vector& d) const {
  const linalg::Vector rows = stress_rows_ * d;
  return stresses_of_rows(rows, num_solids_, num_shells_);
}

}  // namespace buckens::fem
