// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens_petsc {

/// A file that vanishes with its descriptor, on a disk: one in memory would help nobody. −1: none.
int nameless_file();

}  // namespace buckens_petsc
