// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace buckens::loads {

/// The symmetric root of a positive semidefinite matrix.
Eigen::Matrix2d symmetric_root(const Eigen::Matrix2d& square);

}  // namespace buckens::loads
