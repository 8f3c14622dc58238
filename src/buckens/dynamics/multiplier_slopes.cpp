// SPDX-License-Identifier: Apache-2.0
// The matrix of multipliers where it is not that of corrections: forces that grow with multipliers,
// and soft rows that have changed since.
#include "buckens/dynamics/multiplier_condensation.h"

namespace buckens::dynamics {

void MultiplierCondensation::factorise_with_slopes(const std::vector<double>& soft_compliance) {
  has_sloped_ = false;
  if (slopes_.empty()) return;
  if (!sloped_) sloped_ = block_lu_;
  keep_before_slopes(block_lu_);
  sloped_->take_values(block_lu_);
  subtract_slopes(soft_compliance, *sloped_);
  has_sloped_ = sloped_->factorise() && sloped_->pivot_ratio() > kPoorPivot;
}

bool MultiplierCondensation::factorise_multipliers(const std::vector<BodyCompliance>& compliance,
                                                   const std::vector<double>& soft_compliance) {
  has_sloped_ = false;
  if (num_loose_ > 0 || exchanges_rows_) return false;
  if (!sloped_) sloped_ = block_lu_;
  assemble(compliance, soft_compliance, *sloped_);
  keep_before_slopes(*sloped_);
  subtract_slopes(soft_compliance, *sloped_);
  has_sloped_ = sloped_->factorise() && sloped_->pivot_ratio() > kPoorPivot;
  if (!has_sloped_ && !slopes_.empty()) leave_slopes_out();
  return has_sloped_;
}

void MultiplierCondensation::keep_before_slopes(const linalg::BlockLu& S) {
  if (before_slopes_) {
    before_slopes_->take_values(S);
  } else {
    before_slopes_ = S;
  }
}

void MultiplierCondensation::leave_slopes_out() {
  slopes_.clear();
  sloped_->take_values(*before_slopes_);
  has_sloped_ = sloped_->factorise() && sloped_->pivot_ratio() > kPoorPivot;
}

void MultiplierCondensation::renew_slopes(const std::vector<MultiplierSlope>& slopes,
                                          const std::vector<double>& soft_compliance) {
  if (!has_sloped_) return;
  slopes_ = slopes;
  find_idle_blocks();
  sloped_->take_values(*before_slopes_);
  sloped_->set_alone(is_idle_);
  subtract_slopes(soft_compliance, *sloped_);
  has_sloped_ = sloped_->factorise() && sloped_->pivot_ratio() > kPoorPivot;
  if (!has_sloped_) leave_slopes_out();
}

void MultiplierCondensation::subtract_slopes(const std::vector<double>& soft_compliance,
                                             linalg::BlockLu& from) const {
  const int first_soft = size() - static_cast<int>(soft_compliance.size());
  for (const MultiplierSlope& slope : slopes_) {
    const int i = force_.block_of(slope.soft_row), j = force_.block_of(slope.row);
    const int place = from.place(i, j);
    const int entry = force_.number_in_block(slope.row) * from.stride(place) +
                      force_.number_in_block(slope.soft_row);
    from.block(place)[entry] -=
        soft_compliance[static_cast<std::size_t>(slope.soft_row - first_soft)] * slope.value;
  }
}

}  // namespace buckens::dynamics
