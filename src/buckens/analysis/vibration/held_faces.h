// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/mass_metric.h"

namespace buckens::analysis {

/// Which rows of frozen friction hold an elastic contact in small vibrations.
///
/// The spots of a plane face hold two ways along it and the turn about its normal, however many
/// they are. If a face is not quite plane, neither are its rows: all of them together would also
/// hold it from rocking on its springs, which no friction does. So of each face at most three rows
/// count, those that say most in the mass metric.
/// @param stands which rows are closed
/// @return one entry per row: 0 for a row along a face that does not count, 1 for all others
std::vector<char> rows_that_hold(const RestRows& rest, const RestValues& values,
                                 const RestStands& stands, const dynamics::MassMetric& metric);

}  // namespace buckens::analysis
