// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::base {

/// Gives memory that is free but still held by the allocator back to the system, where it can be
/// asked to (glibc). Factorisations leave a tenth of their size behind in freed blocks. Takes some
/// milliseconds: for the end of a set-up, not for steps.
void return_free_memory();

}  // namespace buckens::base
