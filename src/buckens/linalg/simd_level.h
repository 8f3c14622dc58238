// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// Vector instructions that the kernels of PanelFactor exist for.
enum class SimdLevel {
  portable,  ///< what every processor of the architecture has
  avx2,      ///< AVX2 with fused multiply-add
  avx512,    ///< AVX-512 F, VL and DQ
};

/// The highest level that this processor and this build offer.
SimdLevel best_simd_level();

/// "portable", "avx2", "avx512".
const char* to_string(SimdLevel level);

}  // namespace buckens::linalg
