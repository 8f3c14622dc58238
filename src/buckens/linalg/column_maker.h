// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

/// Makes columns of matrices for the plug-in, in a process that serves. One at a time.
BuckensGridMaker column_maker(MakeColumns make);

}  // namespace buckens::linalg
