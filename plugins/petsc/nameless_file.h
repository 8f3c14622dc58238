// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens_petsc {

/// A file that vanishes with its descriptor, on a disk of this machine: one in memory would help
/// nobody, and a network is slow. −1: none, or the environment variable BUCKENS_MPI_DISK is "off".
int nameless_file();

}  // namespace buckens_petsc
