// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step_operator.h"

#include <algorithm>
#include <vector>

namespace buckens::stepping {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Up to this size the dense inverse is quicker than a sparse solve and as accurate.
constexpr Eigen::Index kSmall = 24;

SparseMatrix step_matrix(const body::FlexiblePart& part, const Scheme& scheme) {
  SparseMatrix K_hat = scheme.mass * part.fe.M + scheme.stiffness * part.fe.K;
  if (part.is_damped()) K_hat += scheme.damping * part.C;
  K_hat.makeCompressed();
  return K_hat;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of(const body::FlexiblePart& part) {
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  RowMajor interface = part.rows.topRows(part.num_interface_rows);
  if (!part.coupling.may_use_patterns()) return interface;
  const Matrix& patterns = part.invariants.centrifugal_patterns();
  std::vector<linalg::Triplet> entries;
  for (int k = 0; k < interface.outerSize(); ++k) {
    for (RowMajor::InnerIterator it(interface, k); it; ++it) {
      entries.emplace_back(k, static_cast<int>(it.col()), it.value());
    }
  }
  const auto first = static_cast<int>(interface.rows());
  for (int k = 0; k < static_cast<int>(patterns.cols()); ++k) {
    for (int i = 0; i < static_cast<int>(patterns.rows()); ++i) {
      if (patterns(i, k) != 0.0) entries.emplace_back(first + k, i, patterns(i, k));
    }
  }
  RowMajor out(first + static_cast<int>(patterns.cols()), part.num_dofs());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Whether K̂ is diagonal and nothing has to be sieved, as for reduced bodies.
bool is_division_enough(const body::FlexiblePart& part, const SparseMatrix& K_hat) {
  if (part.sieve.rank() > 0 || K_hat.nonZeros() != K_hat.rows()) return false;
  for (int j = 0; j < K_hat.outerSize(); ++j) {
    const SparseMatrix::InnerIterator entry(K_hat, j);
    if (!entry || entry.row() != j) return false;
  }
  return true;
}

bool have_one_matrix(const Scheme& a, const Scheme& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

/// Equal to the last bit.
bool are_equal(const SparseMatrix& A, const SparseMatrix& B) {
  if (A.rows() != B.rows() || A.nonZeros() != B.nonZeros()) return false;
  const auto same = [](const auto* a, const auto* b, Eigen::Index count) {
    return std::equal(a, a + count, b);
  };
  return same(A.valuePtr(), B.valuePtr(), A.nonZeros()) &&
         same(A.innerIndexPtr(), B.innerIndexPtr(), A.nonZeros()) &&
         same(A.outerIndexPtr(), B.outerIndexPtr(), A.outerSize() + 1);
}

}  // namespace

bool BodyStepOperator::fits(const body::FlexiblePart& part) const {
  return are_equal(part.fe.M, part_->fe.M) && are_equal(part.fe.K, part_->fe.K) &&
         are_equal(part.C, part_->C);
}

BodyStepOperator::BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme,
                                   const BodyStepOperator* twin, linalg::SolveExchange* exchange)
    : part_(&part), scheme_(scheme), N_(rows_of(part)), inertial_(part, scheme) {
  {
    const SparseMatrix K_hat = step_matrix(part, scheme);
    diagonal_ = K_hat.diagonal();
    if (is_division_enough(part, K_hat)) {
      diagonal_inverse_ = diagonal_.cwiseInverse();
    } else {
      find_factor(K_hat, twin, exchange);
    }
  }
  if (!is_diagonal() && part.num_dofs() <= kSmall) {
    inverse_ = factor_->solve(Matrix::Identity(part.num_dofs(), part.num_dofs()));
    part.sieve.apply(inverse_);
  }
  G_ = N_.transpose();
  solve_columns(G_);
  if (scheme.weight == 1.0) {
    // The strain answers the corrected position, the inertia does not: FM (37) with x⁺ shifted by
    // G e leaves Y K̂⁻¹ (m M + c C) G e.
    const Matrix interface = G_.leftCols(part.num_interface_rows);
    Matrix inertia = scheme.mass * (part.fe.M * interface);
    if (part.is_damped()) inertia += scheme.damping * (part.C * interface);
    solve_columns(inertia);
    D_ = Matrix::Zero(G_.rows(), G_.cols());
    D_.leftCols(interface.cols()) = inertia;
  } else {
    D_ = G_;
  }
  NG_ = N_ * G_;
  interface_ = NG_.topLeftCorner(part.num_interface_rows, part.num_interface_rows);
  answer_ = N_ * D_ - NG_;
}

SparseMatrix BodyStepOperator::K_hat() const { return step_matrix(*part_, scheme_); }

void BodyStepOperator::find_factor(const SparseMatrix& K_hat, const BodyStepOperator* twin,
                                   linalg::SolveExchange* exchange) {
  if (twin != nullptr && twin->factor_ && have_one_matrix(scheme_, twin->scheme_) &&
      twin->fits(*part_)) {
    factor_ = twin->factor_;
    is_shared_ = true;
  } else if (exchange != nullptr) {
    const long factorisations = exchange->num_factorisations();
    factor_ = exchange->factor(K_hat);
    is_shared_ = exchange->num_factorisations() == factorisations;
  } else {
    factor_ = std::make_shared<const linalg::SparseCholesky>(K_hat);
  }
}

void BodyStepOperator::solve_columns(Matrix& X) {
  if (is_diagonal()) {
    X = diagonal_inverse_.asDiagonal() * X;
  } else {
    X = factor_->solve(X);
    part_->sieve.apply(X);
  }
  setup_solves_ += X.cols();
}

void BodyStepOperator::free_response(const model::BodyState& before, const History<Vector>& history,
                                     const Vector& load, Vector& free) {
  form_right_side(before, history, load, free);
  solve_right_side(free);
  finish_response(before, history, free);
}

void BodyStepOperator::form_right_side(const model::BodyState& before,
                                       const History<Vector>& history, const Vector& load,
                                       Vector& right) {
  // With x₀ = x + offset:  K̂ x_e = c θ F + M (m x₀ − cθ ẍ₀) + C (d x₀ − cθ ẋ₀),
  // x⁺ = x + (x_e − x₀)/θ.
  const double c_theta = scheme_.force * scheme_.weight;
  with_mass_ = scheme_.mass * before.d - c_theta * history.acceleration;
  if (scheme_.has_offset()) with_mass_ += scheme_.mass * history.offset;
  if (part_->is_damped()) {
    with_damping_ = scheme_.damping * before.d - c_theta * history.mean_velocity;
    if (scheme_.has_offset()) with_damping_ += scheme_.damping * history.offset;
  }
  inertial_.form(with_mass_, with_damping_, right);
  if (load.size() > 0) right += c_theta * load;
}

void BodyStepOperator::solve_right_side(Vector& x, TaskPool* pool) {
  if (is_diagonal()) {
    x = x.cwiseProduct(diagonal_inverse_);
  } else if (inverse_.size() > 0) {
    with_mass_ = x;
    x.noalias() = inverse_ * with_mass_;
  } else {
    factor_->solve_in_place(x, pool);
  }
}

void BodyStepOperator::finish_response(const model::BodyState& before,
                                       const History<Vector>& history, Vector& free) {
  ++solves_;
  if (inertial_.share() != 0.0) free += inertial_.share() * with_damping_;
  if (scheme_.has_offset()) {
    // Sieved where the equations hold: at the end of the step the rule of linear acceleration would
    // let a rigid part of the rates, rounding at first, grow by 2 + √3 per step.
    part_->sieve.apply(free);
    free = before.d + (free - before.d - history.offset) / scheme_.weight;
    return;
  }
  if (scheme_.weight != 1.0) free = before.d + (free - before.d) / scheme_.weight;
  part_->sieve.apply(free);
}

void BodyStepOperator::solve(Vector& x) {
  if (is_diagonal()) {
    x = x.cwiseProduct(diagonal_inverse_);
  } else {
    factor_->solve_in_place(x);
    part_->sieve.apply(x);
  }
  ++setup_solves_;
}

void BodyStepOperator::complete(const Vector& load, const Vector& correction, Vector& x) const {
  x.noalias() += scheme_.force * (G_ * load);
  if (!correction.isZero(0.0)) x.noalias() += D_ * correction;
}

void BodyStepOperator::row_values(const model::BodyState& state, Vector& y, Vector& y_dot,
                                  Vector& y_ddot, Vector& y_alg) const {
  for (Vector* values : {&y, &y_dot, &y_ddot, &y_alg}) values->resize(N_.rows());
  for (int row = 0; row < N_.outerSize(); ++row) {
    double sum = 0, sum_dot = 0, sum_ddot = 0, sum_alg = 0;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(N_, row); it; ++it) {
      sum += it.value() * state.d[it.col()];
      sum_dot += it.value() * state.d_dot[it.col()];
      sum_ddot += it.value() * state.d_ddot[it.col()];
      sum_alg += it.value() * state.d_alg[it.col()];
    }
    y[row] = sum;
    y_dot[row] = sum_dot;
    y_ddot[row] = sum_ddot;
    y_alg[row] = sum_alg;
  }
}

}  // namespace buckens::stepping
