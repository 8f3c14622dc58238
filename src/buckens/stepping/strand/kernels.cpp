// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/simd_level.h"
#include "buckens/stepping/strand/layout.h"

namespace buckens::stepping::strand {

using linalg::SimdLevel;

const Kernels& plane_kernels(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kAvx512Plane;
  if (level == SimdLevel::avx2) return kAvx2Plane;
#endif
  static_cast<void>(level);
  return kPortablePlane;
}

const Kernels& space_kernels(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kAvx512Space;
  if (level == SimdLevel::avx2) return kAvx2Space;
#endif
  static_cast<void>(level);
  return kPortableSpace;
}

}  // namespace buckens::stepping::strand
