// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

// Products of dense columns (OpenBLAS), of which factors of fronts consist.

/// Lower triangle of C ← β C − X Xᵀ. @param n rows of X @param k columns of X
void subtract_square(double beta, double* C, int c_stride, const double* X, int x_stride, int n,
                     int k);

/// C ← β C − X Yᵀ. @param m,n rows of X and of Y @param k columns of both
void subtract_product(double beta, double* C, int c_stride, const double* X, int x_stride,
                      const double* Y, int y_stride, int m, int n, int k);

}  // namespace buckens::linalg
