// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens_petsc {

/// OpenBLAS sets memory aside on its first call, and tries for ever if there is none: so before
/// that of libraries whose errors can be told.
void prepare_blas();

/// Large blocks come from the system one by one and go back when they are freed, which Open MPI
/// keeps the allocator from doing: what was freed would stay, in addition to what comes after.
void return_large_blocks();
/// To the system: what was freed of smaller blocks.
void give_memory_back();

}  // namespace buckens_petsc
