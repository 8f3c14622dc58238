// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_kernels_impl.h"

namespace buckens::linalg {

const NodeKernels kPortableNodeKernels = node_kernels_of<2>();

}  // namespace buckens::linalg
