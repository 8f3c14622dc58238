// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_kernels_impl.h"

#if defined(__x86_64__)

namespace buckens::linalg {

const NodeKernels kAvx512NodeKernels = node_kernels_of<8>();

}  // namespace buckens::linalg

#endif
