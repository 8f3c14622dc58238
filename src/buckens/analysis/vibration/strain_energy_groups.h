// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/body/body.h"

namespace buckens::analysis {

/// Splits a body's strain energy ½ dᵀKd by groups of elements: each beam and each bar of the model
/// file, all solids of a kind together.
class StrainEnergyGroups {
 public:
  explicit StrainEnergyGroups(const fem::FeModel& fe);

  /// "beam 1", counted from 1 in the order of the model file, "bar 3", "solids".
  const std::vector<std::string>& names() const { return names_; }
  /// Energy of each group over their sum; zeros without energy.
  std::vector<double> shares(const linalg::Vector& d) const;

 private:
  std::vector<std::string> names_;
  std::vector<linalg::SparseMatrix> stiffness_;  // of each group; none where there is only one
};

}  // namespace buckens::analysis
