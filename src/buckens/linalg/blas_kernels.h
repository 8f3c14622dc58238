// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::linalg {

/// Makes OpenBLAS use the vector instructions of the processor, once per process. For programs to
/// call before anything else: it affects the whole process and temporarily sets an environment
/// variable, so the library never calls it itself. Results change by rounding only.
///
/// OpenBLAS chooses kernels by the model number of the processor. A processor newer than the
/// library gets the kernels for processors without AVX (`Prescott`), which multiply matrices five
/// times slower. Where that happened although AVX2 or AVX-512 is available, and OPENBLAS_CORETYPE
/// is not set, the kernels of the nearest known processor are chosen instead. OpenBLAS has no
/// documented function for it; if the one used at its own start-up is missing, nothing is changed.
void choose_blas_kernels();

/// Kernels in use, by OpenBLAS' name: "SkylakeX", "Haswell", …
std::string blas_kernels();

}  // namespace buckens::linalg
