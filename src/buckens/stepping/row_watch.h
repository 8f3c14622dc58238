// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/joint_set.h"
#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/model/model.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// Watches whether joint rows are satisfied, above all those left out because they follow from
/// others.
///
/// Rows are compared on one scale: lengths as fractions of the model's length, angles in rad.
class RowWatch {
 public:
  explicit RowWatch(const model::Model& model);

  /// Reports the residuals of rows at the end of a step. Cost: one pass over the residuals.
  /// @param place_in_use per row, −1 for those not in use
  /// @return a row not in use that contradicts the others by more than a millionth; −1: none
  int look(const dynamics::JointResiduals& residuals, const std::vector<int>& place_in_use,
           StepReport& report);

  /// Whether a row not in use has opened since rows were chosen.
  bool has_open_rows() const { return has_open_rows_; }
  void rows_are_chosen() { has_open_rows_ = false; }

  /// Saves or restores what later steps depend on. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

  /// Message about a row that look() returned: its joint, the joints it contradicts, the instant
  /// and the size of its residual.
  /// @param rows all of them, @param in_use those in use, ascending
  std::string describe_contradiction(int row, double t, const dynamics::JointResiduals& residuals,
                                     const std::vector<dynamics::SystemRow>& rows,
                                     const std::vector<dynamics::BodyCompliance>& compliance,
                                     const std::vector<int>& in_use) const;

  /// Whether a row of λ closes a length, not an angle.
  bool is_length(int row) const { return is_length_[static_cast<std::size_t>(row)] != 0; }

 private:
  const model::Model& model_;
  std::vector<char> is_length_;  // of every row
  std::vector<double> size_;     // model's length for rows that are lengths, 1 for angles
  double largest_gap_ = 0;       // of rows not in use so far
  bool has_open_rows_ = false;
};

}  // namespace buckens::stepping
