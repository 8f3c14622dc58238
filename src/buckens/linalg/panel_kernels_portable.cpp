// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_kernels_impl.h"

namespace buckens::linalg {

const PanelKernels kPortablePanelKernels = kernels_of<2>();

}  // namespace buckens::linalg
