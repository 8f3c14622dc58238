// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/dense_cholesky.h"

namespace buckens::linalg {

DenseCholesky::DenseCholesky(const Matrix& A) : factor_(A) {}

bool DenseCholesky::is_positive_definite() const { return factor_.info() == Eigen::Success; }

double DenseCholesky::rcond() const { return factor_.rcond(); }

Matrix DenseCholesky::lower() const { return factor_.matrixL(); }

Vector DenseCholesky::diagonal() const { return factor_.matrixLLT().diagonal(); }

Vector DenseCholesky::solve(const Vector& b) const { return factor_.solve(b); }

Matrix DenseCholesky::solve(const Matrix& B) const { return factor_.solve(B); }

void DenseCholesky::solve_in_place(Matrix& B) const { factor_.solveInPlace(B); }

Matrix DenseCholesky::solve_lower(const Matrix& B) const { return factor_.matrixL().solve(B); }

}  // namespace buckens::linalg
