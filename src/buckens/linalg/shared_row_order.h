// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace buckens::linalg {

class RowOrder;

/// Null: rows are variables, and each process has a run of them as long as the others'.
using SharedRowOrder = std::shared_ptr<const RowOrder>;

}  // namespace buckens::linalg
