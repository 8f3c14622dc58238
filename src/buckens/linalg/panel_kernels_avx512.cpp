// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_kernels_impl.h"

#if defined(__x86_64__)

namespace buckens::linalg {

const PanelKernels kAvx512PanelKernels = kernels_of<8>();

}  // namespace buckens::linalg

#endif
