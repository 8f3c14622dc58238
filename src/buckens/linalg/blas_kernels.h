// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::linalg {

/// Lets OpenBLAS use the vector instructions that the processor has, once per process. For
/// programs, before anything else: it concerns the whole process and sets an environment variable
/// meanwhile, so the library never calls it by itself. Results change in rounding only.
///
/// OpenBLAS chooses kernels by the model number of the processor. One that is newer than the
/// library gets those for processors without AVX (`Prescott`), which multiply matrices five times
/// slower. Where that has happened, AVX2 or AVX-512 is there, and OPENBLAS_CORETYPE does not say
/// otherwise, the kernels of the nearest known processor are chosen anew. OpenBLAS has no
/// documented function for it; if the one that its own start uses is missing, all stays as it is.
void choose_blas_kernels();

/// Kernels in use, as OpenBLAS names them: "SkylakeX", "Haswell", …
std::string blas_kernels();

}  // namespace buckens::linalg
