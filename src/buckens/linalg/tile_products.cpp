// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tile_products.h"

#include <cblas.h>

namespace buckens::linalg {

void subtract_square(double beta, double* C, int c_stride, const double* X, int x_stride, int n,
                     int k) {
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, -1.0, X, x_stride, beta, C, c_stride);
}

void subtract_product(double beta, double* C, int c_stride, const double* X, int x_stride,
                      const double* Y, int y_stride, int m, int n, int k) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, k, -1.0, X, x_stride, Y, y_stride,
              beta, C, c_stride);
}

}  // namespace buckens::linalg
