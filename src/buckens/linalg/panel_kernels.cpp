// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_kernels.h"

namespace buckens::linalg {

const PanelKernels& panel_kernels(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kAvx512PanelKernels;
  if (level == SimdLevel::avx2) return kAvx2PanelKernels;
#endif
  static_cast<void>(level);
  return kPortablePanelKernels;
}

}  // namespace buckens::linalg
