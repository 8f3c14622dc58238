// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens_petsc {

/// Ends the run, where the others may be waiting for what this process no longer has.
/// @param rank of this process @param remedy what helps
[[noreturn]] void abort_alone(int rank, const char* reason, const char* remedy);

}  // namespace buckens_petsc
