// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/complementarity.h"

#include <vector>

#include <fmt/format.h>

#include "buckens/linalg/dense_ldlt.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

// Added to what stops answer, as a share of the largest answer: those that hold the same share the
// push.
constexpr double kNoAnswer = 1e-12;

}  // namespace

Vector solve_complementarity(const Matrix& D, const Vector& b) {
  const auto n = static_cast<int>(b.size());
  Vector P = Vector::Zero(n);
  const double least = kNoAnswer * D.diagonal().maxCoeff();
  std::vector<char> is_active(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) is_active[static_cast<std::size_t>(i)] = b[i] > 0.0;
  for (int round = 0; round < 50 * n; ++round) {
    std::vector<int> active;
    for (int i = 0; i < n; ++i) {
      if (is_active[static_cast<std::size_t>(i)]) active.push_back(i);
    }
    P.setZero();
    if (!active.empty()) {
      const Matrix A = D(active, active);
      const Vector asked = b(active);
      const linalg::DenseLdlt factor(A + least * Matrix::Identity(A.rows(), A.rows()));
      Vector part = factor.solve(asked);
      part += factor.solve(Vector(asked - A * part));  // what `least` has taken
      P(active) = part;
    }
    int worst = -1;
    for (const int i : active) {
      if (P[i] < 0.0 && (worst < 0 || P[i] < P[worst])) worst = i;
    }
    if (worst >= 0) {
      is_active[static_cast<std::size_t>(worst)] = 0;
      continue;
    }
    const Vector open = D * P - b;
    const double rounding = 1e-12 * (b.cwiseAbs().maxCoeff() + (D * P).cwiseAbs().maxCoeff());
    for (int i = 0; i < n; ++i) {
      if (is_active[static_cast<std::size_t>(i)] || open[i] >= -rounding) continue;
      if (worst < 0 || open[i] < open[worst]) worst = i;
    }
    if (worst < 0) return P;
    is_active[static_cast<std::size_t>(worst)] = 1;
  }
  throw StepFailure(fmt::format(
      "no impulses satisfy all {} rigid stops that are struck at once; give one of them "
      "a `stiffness`",
      n));
}

}  // namespace buckens::stepping
