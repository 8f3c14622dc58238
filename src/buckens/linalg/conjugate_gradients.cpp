// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {
constexpr double kTolerance = 1e-14;
// Once below this, a residual that no longer falls is at the limit of rounding.
constexpr double kAcceptable = 1e-10;

template <class Product>
Vector solve_by_products(const Vector& diagonal, const Vector& b, Product&& product) {
  const Eigen::Index n = b.size();
  const Vector inverse = (diagonal.array() > 0.0).select(diagonal.cwiseInverse(), Vector::Zero(n));
  Vector x = Vector::Zero(n);
  Vector r = (diagonal.array() > 0.0).select(b, Vector::Zero(n));
  Vector z = inverse.cwiseProduct(r);
  Vector p = z;
  double rz = r.dot(z);
  const double scale = rz;
  if (!std::isfinite(scale)) {
    throw NumericalError("a load on a mass matrix of size " + std::to_string(n) +
                         " is not finite; check loads, velocities and their units");
  }
  Vector image(n);
  double best = 1.0;
  int since_best = 0;
  const double cap = 50.0 + 20.0 * std::sqrt(static_cast<double>(n)) + static_cast<double>(n);
  const int max_iterations = static_cast<int>(std::min(cap, 20000.0));
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const double relative = scale > 0.0 ? std::sqrt(rz / scale) : 0.0;
    since_best = relative < best ? 0 : since_best + 1;
    best = std::min(best, relative);
    if (relative <= kTolerance || (best < kAcceptable && since_best > 10)) return x;
    product(p, image);
    const Vector Ap = (diagonal.array() > 0.0).select(image, Vector::Zero(n));
    const double step = rz / p.dot(Ap);
    x += step * p;
    r -= step * Ap;
    z = inverse.cwiseProduct(r);
    const double rz_new = r.dot(z);
    p = z + (rz_new / rz) * p;
    rz = rz_new;
  }
  throw NumericalError("conjugate gradients on a mass matrix of size " + std::to_string(n) +
                       " did not converge in " + std::to_string(max_iterations) +
                       " iterations; check densities and element shapes of the body");
}

}  // namespace

Vector conjugate_gradients(const SparseMatrix& A, const Vector& b) {
  return solve_by_products(A.diagonal(), b,
                           [&A](const Vector& p, Vector& image) { image.noalias() = A * p; });
}

Vector conjugate_gradients(const SymmetricMatrix& A, const Vector& b) {
  if (!A.is_divided() && A.nodes() == nullptr && A.blocks() == nullptr) {
    return conjugate_gradients(A.whole(), b);
  }
  return solve_by_products(A.diagonal(), b, [&A](const Vector& p, Vector& image) {
    multiply({{&A, &p, &image}});
  });
}

}  // namespace buckens::linalg
