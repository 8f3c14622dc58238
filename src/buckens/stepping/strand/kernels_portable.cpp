// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/joints_impl.h"

namespace buckens::stepping::strand {

const Kernels kPortablePlane = kernels_of<Plane>();
const Kernels kPortableSpace = kernels_of<Space>();

}  // namespace buckens::stepping::strand
