// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/dense_ldlt.h"

namespace buckens::linalg {

DenseLdlt::DenseLdlt(const Matrix& A) : factor_(A) {}

Vector DenseLdlt::solve(const Vector& b) const { return factor_.solve(b); }

Matrix DenseLdlt::solve(const Matrix& B) const { return factor_.solve(B); }

}  // namespace buckens::linalg
