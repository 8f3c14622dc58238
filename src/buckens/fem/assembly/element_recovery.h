// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/assembly/recovery.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::fem {

/// Section forces and stresses of some elements of a mesh from the few nodal variables on which
/// they depend, with the bits of Recovery and SolidRecovery.
class ElementRecovery {
 public:
  ElementRecovery() = default;
  /// @param lines of all line elements; must outlive it
  /// @param of_lines numbers of line elements, ascending
  /// @param of_solids of solids and shells, ascending, see num_solids()
  ElementRecovery(const FeModel& fe, const Recovery& lines, std::vector<int> of_lines,
                  const std::vector<int>& of_solids);

  /// Nodal variables that are read, ascending.
  const std::vector<int>& variables() const { return variables_; }
  /// 12×(number of line elements), see Recovery. @param d of variables()
  linalg::Matrix section_forces(const linalg::Vector& d) const;
  /// 2×(number of line elements)
  linalg::Matrix stresses(const linalg::Matrix& section_forces) const;
  /// 7×(number of solids and shells), see SolidRecovery. @param d of variables()
  linalg::Matrix solid_stresses(const linalg::Vector& d) const;

 private:
  const Recovery* lines_ = nullptr;
  std::vector<int> of_lines_;
  std::vector<int> variables_;
  linalg::SparseRows::RowMajor force_rows_, stress_rows_;  // their columns are variables()
  Eigen::Index num_solids_ = 0, num_shells_ = 0;
};

}  // namespace buckens::fem
