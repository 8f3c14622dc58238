// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/blas_kernels.h"

#include <cstdlib>
#include <mutex>

#include <cblas.h>

#include "buckens/linalg/simd_level.h"

// Exported by OpenBLAS where it is built for several processors, absent otherwise.
extern "C" {
__attribute__((weak)) void gotoblas_dynamic_init();
__attribute__((weak)) void gotoblas_dynamic_quit();
}

namespace buckens::linalg {

namespace {

constexpr char kVariable[] = "OPENBLAS_CORETYPE";

void choose() {
  const SimdLevel level = best_simd_level();
  if (level == SimdLevel::portable || std::getenv(kVariable) != nullptr) return;
  if (blas_kernels() != "Prescott") return;
  if (gotoblas_dynamic_init == nullptr || gotoblas_dynamic_quit == nullptr) return;
  setenv(kVariable, level == SimdLevel::avx512 ? "SkylakeX" : "Haswell", 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  unsetenv(kVariable);
}

}  // namespace

void choose_blas_kernels() {
  static std::once_flag once;
  std::call_once(once, choose);
}

std::string blas_kernels() { return openblas_get_corename(); }

}  // namespace buckens::linalg
