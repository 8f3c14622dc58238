// SPDX-License-Identifier: Apache-2.0
// Corrections of positions in the iteration of a step.
#include <algorithm>
#include <cmath>

#include "buckens/stepping/small_newton.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {
// A correction itself opens gaps of its square divided by the model's length. If this exceeds the
// following fraction of the gaps to be closed, iterations do not converge.
constexpr double kOpensItself = 0.1;
}  // namespace

void SmallNewton::find_open_positions() {
  const auto in_use = static_cast<Eigen::Index>(rows_in_use_.size());
  E_.setZero(condensation_->size());
  for (Eigen::Index k = 0; k < in_use; ++k) {
    const int row = rows_in_use_[static_cast<std::size_t>(k)];
    // A correction of positions rolls as well: of rows without a position it changes nothing.
    if (rates_only_[static_cast<std::size_t>(row)]) continue;
    E_[k] = residuals_.g_dot[row] / scheme_.end_rate - residuals_.g[row];
  }
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const loads::RigidRow* row = closed_row(k);
    if (row == nullptr || !row->holds_position) continue;
    E_[in_use + static_cast<Eigen::Index>(k)] = row->slip / scheme_.end_rate - row->gap;
  }
}

void SmallNewton::solve_correction(const std::vector<BodyStep>& bodies, double t) {
  if (corrects_positions()) {
    find_open_positions();
    if (!correct_by_sliding(bodies, t)) {
      condensation_->solve_in_place(E_);
      condensation_->gather(E_, correction_);
    }
  } else {
    E_.setZero(condensation_->size());
    condensation_->gather(E_, correction_);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    shares_[b].answer_correction(bodies[b], correction_[b]);
  }
}

double SmallNewton::size_of_correction(const std::vector<BodyStep>& bodies) const {
  double size = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    size = larger(size, shares_[b].size_of_correction(bodies[b], correction_[b]));
  }
  return size;
}

bool SmallNewton::correct_by_sliding(const std::vector<BodyStep>& bodies, double t) {
  const auto sticks = [this](std::size_t k) {
    const loads::RigidRow* row = closed_row(k);
    return row != nullptr && !row->holds_position;
  };
  bool is_there = sliding_ != nullptr;
  for (std::size_t k = 0; k < soft_.rows.size() && !is_there; ++k) is_there = sticks(k);
  if (!is_there) return false;
  if (!sliding_) {
    open_ = E_;
    condensation_->solve_in_place(E_);
    condensation_->gather(E_, correction_);
    const double size = size_of_correction(bodies);
    if (size * size <= kOpensItself * model_.length * open_.cwiseAbs().maxCoeff()) return true;
    const std::vector<dynamics::BodyResponse> sticking = correction_;
    sliding_ = condense_without_sticking(t);
    Vector slid = open_;
    if (sliding_) {
      sliding_->solve_in_place(slid);
      sliding_->gather(slid, correction_);
      if (size_of_correction(bodies) < size) {
        E_ = slid;
        return true;
      }
    }
    sliding_.reset();
    correction_ = sticking;
    return true;
  }
  sliding_->solve_in_place(E_);
  sliding_->gather(E_, correction_);
  return true;
}

std::unique_ptr<dynamics::MultiplierCondensation> SmallNewton::condense_without_sticking(double t) {
  std::vector<dynamics::SystemRow> rows = row_pattern(t);
  auto out = std::make_unique<dynamics::MultiplierCondensation>(
      static_cast<int>(model_.bodies.size()), rows, soft_.num_of_groups);
  std::vector<double> compliance;
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const loads::RigidRow* closed = closed_row(k);
    const double k_eff =
        scheme_.weight * correcting_stiffness_[k] + scheme_.mean_rate * correcting_damping_[k];
    if (closed != nullptr && closed->holds_position) {
      compliance.push_back(kRigidGive * own_compliance(soft_.rows[k], compliance_));
    } else if (closed == nullptr && k_eff > 0.0) {
      compliance.push_back(1.0 / (scheme_.force * k_eff));
    } else {
      compliance.push_back(1.0);
      rows[rows_in_use_.size() + k] = {};
    }
  }
  std::vector<dynamics::SystemRow> test = rows;
  for (dynamics::SystemRow& row : test) row = without_rates(row);
  return out->factorise(test, rows, compliance_, compliance) ? std::move(out) : nullptr;
}

}  // namespace buckens::stepping
