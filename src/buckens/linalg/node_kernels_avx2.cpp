// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_kernels_impl.h"

#if defined(__x86_64__)

namespace buckens::linalg {

const NodeKernels kAvx2NodeKernels = node_kernels_of<4>();

}  // namespace buckens::linalg

#endif
