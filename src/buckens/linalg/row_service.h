// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/grid_plugin.h"

namespace buckens::linalg {

/// Lets the plug-in have this process work on its rows of vectors (RowWorker).
void serve_rows(BuckensGridMaker& maker);

}  // namespace buckens::linalg
