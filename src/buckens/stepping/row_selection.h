// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/linalg/row_rank.h"

namespace buckens::stepping {

/// Splits joint rows, FM (34), into independent ones and those that follow from them at one
/// configuration.
///
/// Which rows are independent can change as a mechanism moves: of three parallel cranks on one
/// coupler, each becomes redundant once per turn. Rank-revealing QR of the Jacobian times the
/// step's compliance, rows scaled to unit length.
/// @param rows all joint rows
/// @param compliance one entry per body
linalg::RowRank select_rows(const model::Model& model, const std::vector<dynamics::SystemRow>& rows,
                            const std::vector<dynamics::BodyCompliance>& compliance);

/// The rows of `independent` from which another one follows, leaving out those with less than a
/// thousandth of the combination: the rows that contradict it if it does not hold. Ascending. Cost:
/// least squares by conjugate gradients; meant for messages.
std::vector<int> rows_behind(const model::Model& model,
                             const std::vector<dynamics::SystemRow>& rows,
                             const std::vector<dynamics::BodyCompliance>& compliance,
                             const std::vector<int>& independent, int row);

}  // namespace buckens::stepping
