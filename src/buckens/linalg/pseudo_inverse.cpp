// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/pseudo_inverse.h"

namespace buckens::linalg {

void PseudoInverse::compute(const Matrix& A) { orthogonal_.compute(A); }

Vector PseudoInverse::operator*(const Vector& b) const { return orthogonal_.solve(b); }

Matrix PseudoInverse::operator*(const Matrix& B) const { return orthogonal_.solve(B); }

Matrix PseudoInverse::whole() const { return orthogonal_.pseudoInverse(); }

}  // namespace buckens::linalg
