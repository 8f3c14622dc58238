// SPDX-License-Identifier: Apache-2.0
// Which rows of joints are in use, and the condensed matrix of all rows.
#include <algorithm>
#include <array>
#include <utility>

#include "buckens/base/errors.h"
#include "buckens/stepping/row_selection.h"
#include "buckens/stepping/small_newton.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

/// Calls f for the rows that are not in use. @param rows_in_use ascending
template <class F>
void for_other_rows(const std::vector<int>& rows_in_use, Eigen::Index count, F&& f) {
  std::size_t next = 0;
  for (Eigen::Index row = 0; row < count; ++row) {
    if (next < rows_in_use.size() && rows_in_use[next] == row) {
      ++next;
    } else {
      f(row);
    }
  }
}

}  // namespace

void SmallNewton::number_rows_in_use() {
  place_in_use_.assign(static_cast<std::size_t>(model_.num_constraint_rows()), -1);
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    place_in_use_[static_cast<std::size_t>(rows_in_use_[k])] = static_cast<int>(k);
  }
}

void SmallNewton::set_joint_rows(double t) {
  auto& rows = rows_of_joint_;
  auto& acting = acting_of_joint_;
  const bool same = scheme_.weight == 1.0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_.derivatives(j, end_, t + scheme_.h, around_.memory, rows);
    if (!same)
      joints_.derivatives(j, evaluation_, scheme_.evaluation_time(t), around_.memory, acting);
    for (int k = 0; k < joints_.num_rows(j); ++k) {
      const int place = place_in_use_[static_cast<std::size_t>(joints_.first_row(j) + k)];
      if (place < 0) continue;
      const dynamics::SystemRow& row = rows[static_cast<std::size_t>(k)];
      if (same && !has_quasi_static_) {
        condensation_->set_row(place, row);
      } else {
        condensation_->set_row(place, without_rates(row),
                               same ? row : acting[static_cast<std::size_t>(k)]);
      }
    }
  }
}

std::vector<dynamics::SystemRow> SmallNewton::row_pattern(double t) {
  std::vector<dynamics::SystemRow> pattern(rows_in_use_.size());
  std::array<dynamics::SystemRow, dynamics::JointSet::kMostRows> rows;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_.derivatives(j, end_, t + scheme_.h, around_.memory, rows);
    for (int k = 0; k < joints_.num_rows(j); ++k) {
      const int place = place_in_use_[static_cast<std::size_t>(joints_.first_row(j) + k)];
      if (place >= 0) pattern[static_cast<std::size_t>(place)] = rows[static_cast<std::size_t>(k)];
    }
  }
  // Soft rows without effect keep their bodies, so that the pattern never changes.
  pattern.insert(pattern.end(), soft_.rows.begin(), soft_.rows.end());
  return pattern;
}

bool SmallNewton::condense(double t) {
  if (!condensation_) {
    condensation_ = std::make_unique<dynamics::MultiplierCondensation>(
        static_cast<int>(model_.bodies.size()), row_pattern(t), soft_.num_of_groups);
    condensation_->pivot_as(pivoted_);
    pivoted_.clear();
    corrected_.resize(condensation_->size());  // not at the first step in which something sticks
  }
  set_joint_rows(t);
  keep_for_corrections();
  set_soft_rows(soft_.stiffness, soft_.damping);
  set_slopes();
  return condensation_->factorise(compliance_, soft_compliance_);
}

bool SmallNewton::select_rows_anew(double t, bool may_give_up) {
  watch_.rows_are_chosen();
  std::vector<dynamics::BodyCompliance> compliance = compliance_;
  for (std::size_t b = 0; b < compliance.size(); ++b) {
    if (shares_[b].is_quasi_static()) compliance[b].interface = nullptr;
  }
  dynamics::Constraints all;
  dynamics::evaluate_constraints(model_, end_, t + scheme_.h, around_.memory, all);
  linalg::RowRank rank = select_rows(model_, all.rows, compliance);
  dependent_ = std::move(rank.dependent);
  // Fewer rows mean a dead centre. Near it the step continues with the rows it has; exactly at it,
  // they hold nothing in this step, and the motion carries the mechanism through.
  const bool are_fewer = rank.independent.size() < rows_in_use_.size();
  if (rank.independent == rows_in_use_ || (are_fewer && !may_give_up)) return false;
  gave_up_rows_ = are_fewer;
  is_evaluated_ = false;  // multipliers of rows that are no longer in use vanish
  rows_in_use_ = std::move(rank.independent);
  std::sort(rows_in_use_.begin(), rows_in_use_.end());
  number_rows_in_use();
  condensation_.reset();
  ++num_selections_;
  return true;
}

void SmallNewton::follow_released(double t) {
  if (around_.memory == nullptr || around_.memory->released == released_) return;
  released_ = around_.memory->released;
  select_rows_anew(t, true);
  gave_up_rows_ = false;
  trusted_pivots_ = 0.0;
}

void SmallNewton::follow_near() {
  const auto same_rows = [this] { return soft_.num_of_groups == num_of_groups_; };
  if (around_.memory == nullptr || (around_.memory->near == near_ && same_rows())) return;
  near_ = around_.memory->near;
  num_of_groups_ = soft_.num_of_groups;
  // Rows that were exchanged for their pivots are those of joints: they stay.
  if (condensation_) pivoted_ = condensation_->pivoted_values();
  condensation_.reset();
}

void SmallNewton::leave_to_rows_in_use(Vector& lambda) const {
  for_other_rows(rows_in_use_, lambda.size(), [&](Eigen::Index row) { lambda[row] = 0.0; });
}

void SmallNewton::watch_rows(double t, StepReport& report) {
  const int row = watch_.look(residuals_, place_in_use_, report);
  if (row < 0) return;
  dynamics::Constraints all;
  dynamics::evaluate_constraints(model_, end_, t + scheme_.h, around_.memory, all);
  throw StepFailure(watch_.describe_contradiction(row, t + scheme_.h, residuals_, all.rows,
                                                  compliance_, rows_in_use_));
}

void SmallNewton::solve_multipliers(double t) {
  const auto in_use = static_cast<Eigen::Index>(rows_in_use_.size());
  const dynamics::RowBlocks& rows = condensation_->test_rows();
  rows.changes(X_, [&](int b) {
    const BodyIteration& share = shares_[static_cast<std::size_t>(b)];
    return dynamics::Displacement{&share.residual_u, &share.y_moving};
  });
  X_ = -X_;
  for (Eigen::Index k = 0; k < in_use; ++k) {
    X_[k] -= residuals_.g_dot[rows_in_use_[static_cast<std::size_t>(k)]] / scheme_.end_rate;
  }
  if (scheme_.weight == 1.0 && has_soft_springs_) {
    rows.changes(corrected_, [&](int b) {
      const BodyIteration& share = shares_[static_cast<std::size_t>(b)];
      return dynamics::Displacement{&share.correction_u, &share.y_correcting};
    });
    for (std::size_t k = 0; k < soft_stiffness_share_.size(); ++k) {
      const Eigen::Index row = in_use + static_cast<Eigen::Index>(k);
      X_[row] -= soft_stiffness_share_[k] * corrected_[row];
    }
  }
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const loads::RigidRow* row = closed_row(k);
    if (row != nullptr) X_[in_use + static_cast<Eigen::Index>(k)] -= row->slip / scheme_.end_rate;
  }
  held_.for_excess(
      at_evaluation(), scheme_.evaluation_time(t), around_, [&](int soft, double excess) {
        const Eigen::Index row = in_use + soft;
        X_[row] += scheme_.force * excess * soft_compliance_[static_cast<std::size_t>(soft)];
      });
  condensation_->solve_with_slopes(X_);
  condensation_->gather(X_, response_);
}

}  // namespace buckens::stepping
