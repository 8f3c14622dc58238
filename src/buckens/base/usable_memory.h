// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::base {

/// Bytes that large matrices of this process may take: half of the memory of the machine, or of
/// what the process may have of it (`ulimit -v`, control groups of containers and of batch
/// systems). The same from run to run, whatever else is running.
double usable_memory();

}  // namespace buckens::base
