// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/joints_impl.h"

#if defined(__x86_64__)

namespace buckens::stepping::strand {

const Kernels kAvx2Plane = kernels_of<Plane>();
const Kernels kAvx2Space = kernels_of<Space>();

}  // namespace buckens::stepping::strand

#endif
