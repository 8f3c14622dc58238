// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_kernels_impl.h"

#if defined(__x86_64__)

namespace buckens::linalg {

const PanelKernels kAvx2PanelKernels = kernels_of<4>();

}  // namespace buckens::linalg

#endif
