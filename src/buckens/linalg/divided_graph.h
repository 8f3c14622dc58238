// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/elimination_order.h"

namespace buckens::linalg {

/// The graph of a sum of divided matrices, as column_graph() finds it for the sum itself. The
/// processes that have its entries send marks of columns and edges of the graph, so that no process
/// has the pattern of the whole. Columns with other rows that have the same 64 bits as their mark
/// would be one vertex, which makes the order of elimination worse and not wrong.
ColumnGraph column_graph(std::span<const DividedMatrix* const> terms);

}  // namespace buckens::linalg
