// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/body/body.h"

namespace buckens::stepping {

/// The sieved nodal values with the least Rayleigh quotient of K and M among displacements that are
/// polynomials of the position: up to degree 3, along slender bodies up to degree 7.
///
/// Cost: a product with M and K for each of 57 polynomials, 77 for slender bodies, and a few
/// vectors of memory per thread.
/// @param pool may share the polynomials; changes no bit
linalg::Vector smooth_shape(const body::FlexiblePart& part, TaskPool* pool);

}  // namespace buckens::stepping
