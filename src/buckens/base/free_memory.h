// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::base {

/// Returns memory that is free but still held by the allocator to the system, where that is
/// possible (glibc). Factorisations leave a tenth of their size behind in freed blocks. Takes a few
/// milliseconds: for the end of a set-up, not for steps.
void return_free_memory();

}  // namespace buckens::base
