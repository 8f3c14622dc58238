// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_kernels.h"

namespace buckens::linalg {

const NodeKernels& node_kernels(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kAvx512NodeKernels;
  if (level == SimdLevel::avx2) return kAvx2NodeKernels;
#endif
  static_cast<void>(level);
  return kPortableNodeKernels;
}

}  // namespace buckens::linalg
