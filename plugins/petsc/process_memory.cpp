// SPDX-License-Identifier: Apache-2.0
#include "process_memory.h"

#include <cstddef>
#include <vector>

#include <malloc.h>

extern "C" void dtrsm_(const char* side, const char* triangle, const char* transposed,
                       const char* diagonal, const int* m, const int* n, const double* alpha,
                       const double* a, const int* lda, double* b, const int* ldb);

namespace buckens_petsc {

void prepare_blas() {
  const int n = 64;
  const double one = 1;
  std::vector<double> a(static_cast<std::size_t>(n) * n, one), b(a);
  dtrsm_("L", "L", "N", "U", &n, &n, &one, a.data(), &n, b.data(), &n);
}

void return_large_blocks() {
  constexpr int kLarge = 1 << 20, kManyBlocks = 1 << 16;
  (void)mallopt(M_MMAP_MAX, kManyBlocks);
  (void)mallopt(M_MMAP_THRESHOLD, kLarge);
  (void)mallopt(M_TRIM_THRESHOLD, 4 * kLarge);
}

void give_memory_back() { (void)malloc_trim(0); }

}  // namespace buckens_petsc
