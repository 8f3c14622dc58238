// SPDX-License-Identifier: Apache-2.0
#include "abort_alone.h"

#include <cstdio>
#include <cstdlib>

#include <mpi.h>

namespace buckens_petsc {

namespace {
constexpr int kExitOfErrors = 4;  // code of numerical errors
}  // namespace

void abort_alone(int rank, const char* reason, const char* remedy) {
  std::fprintf(stderr, "buckens: error: process %d cannot go on: %s; %s\n", rank, reason, remedy);
  MPI_Abort(MPI_COMM_WORLD, kExitOfErrors);
  std::abort();
}

}  // namespace buckens_petsc
