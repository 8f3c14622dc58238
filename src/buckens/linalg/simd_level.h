// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// Vector instruction sets for which kernels of PanelFactor exist.
enum class SimdLevel {
  portable,  ///< what every processor of the architecture has
  avx2,      ///< AVX2 with fused multiply-add
  avx512,    ///< AVX-512 F, VL and DQ
};

/// The highest level supported by this processor and this build.
SimdLevel best_simd_level();

/// "portable", "avx2", "avx512".
const char* to_string(SimdLevel level);

}  // namespace buckens::linalg
