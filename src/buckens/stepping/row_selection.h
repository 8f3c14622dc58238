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
/// coupler, each hands over to the others once a turn. Rank-revealing QR of the Jacobian times the
/// step's compliance, rows scaled to unit length.
/// @param rows all joint rows
/// @param compliance one entry per body
linalg::RowRank select_rows(const std::vector<dynamics::SystemRow>& rows,
                            const std::vector<dynamics::BodyCompliance>& compliance);

}  // namespace buckens::stepping
