// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/row_watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/stepping/row_selection.h"

namespace buckens::stepping {

namespace {

// A dependent row stays closed to rounding; beyond this it is no longer dependent, and rows are
// chosen again.
constexpr double kOpenRow = 1e-9;
// Assembly accepts 1e-9 as closed, and rows that replace each other near a dead centre open by less
// than 1e-8 until they are chosen again. A row open by more than this contradicts the others, and
// the motion is not the requested one.
constexpr double kContradiction = 1e-6;
// Methods that close velocities only let all rows drift together: no contradiction.
constexpr double kMoreThanOthers = 10;

/// joint "hinge" (revolute between ground and wheel/hub)
std::string describe_joint(const model::Joint& joint) {
  return fmt::format("joint \"{}\" ({} between {} and {})", joint.name,
                     joints::to_string(joint.type), joint.first.text, joint.second.text);
}

}  // namespace

RowWatch::RowWatch(const model::Model& model) : model_(model) {
  for (const model::Joint& joint : model.joints) {
    for (const joints::ConstraintRow& row : joint.rows) {
      is_length_.push_back(row.is_length());
      size_.push_back(row.is_length() ? model.length : 1.0);
    }
  }
}

int RowWatch::look(const dynamics::JointResiduals& residuals, const std::vector<int>& place_in_use,
                   StepReport& report) {
  double gap = 0;    // of rows not in use
  double drift = 0;  // of rows in use
  int open_row = -1;
  report.opening = report.opening_rate = 0.0;
  for (std::size_t row = 0; row < size_.size(); ++row) {
    const auto k = static_cast<Eigen::Index>(row);
    const double opening = std::abs(residuals.g[k]) / size_[row];
    if (opening >= report.opening) {
      report.opening = opening;
      report.most_open_row = static_cast<int>(row);
    }
    report.opening_rate = std::max(report.opening_rate, std::abs(residuals.g_dot[k]) / size_[row]);
    if (place_in_use[row] >= 0) {
      drift = std::max(drift, opening);
    } else if (opening > gap) {
      gap = opening;
      open_row = static_cast<int>(row);
    }
  }
  if (gap > std::max(kOpenRow, 2.0 * largest_gap_)) {
    largest_gap_ = gap;
    has_open_rows_ = true;
  }
  if (gap <= std::max(kContradiction, kMoreThanOthers * drift)) return -1;
  has_open_rows_ = true;  // a retry uses newly chosen rows
  return open_row;
}

std::string RowWatch::describe_contradiction(
    int row, double t, const dynamics::JointResiduals& residuals,
    const std::vector<dynamics::SystemRow>& rows,
    const std::vector<dynamics::BodyCompliance>& compliance, const std::vector<int>& in_use) const {
  const auto [open, number] = model_.owner_of_row(row);
  std::vector<std::string> others;
  for (const int other : rows_behind(model_, rows, compliance, in_use, row)) {
    const model::Joint* owner = model_.owner_of_row(other).first;
    const std::string text = describe_joint(*owner);
    if (owner != open && (others.empty() || others.back() != text)) others.push_back(text);
  }
  const char* unit = open->rows[static_cast<std::size_t>(number)].is_length() ? "m" : "rad";
  return fmt::format(
      "{} contradicts {} at t = {:.6g} s: its equation {} of {} followed from the others and is "
      "now open by {:.3g} {}; correct axes or laws of motion of these joints, or remove one",
      describe_joint(*open), others.empty() ? "itself" : fmt::format("{}", fmt::join(others, ", ")),
      t, number + 1, open->rows.size(), std::abs(residuals.g[row]), unit);
}

}  // namespace buckens::stepping
