// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step_operator.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "buckens/body/mesh_solver.h"
#include "buckens/linalg/row_parts.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Up to this size the dense inverse is quicker than a sparse solve and as accurate.
constexpr Eigen::Index kSmall = SmallBodyAnswers::kMostVariables;

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
template <class Sparse>
bool are_equal(const Sparse& A, const Sparse& B) {
  if (A.rows() != B.rows() || A.nonZeros() != B.nonZeros()) return false;
  const auto same = [](const auto* a, const auto* b, Eigen::Index count) {
    return std::equal(a, a + count, b);
  };
  return same(A.valuePtr(), B.valuePtr(), A.nonZeros()) &&
         same(A.innerIndexPtr(), B.innerIndexPtr(), A.nonZeros()) &&
         same(A.outerIndexPtr(), B.outerIndexPtr(), A.outerSize() + 1);
}

bool have_same_rigid_modes(const body::FlexiblePart& a, const body::FlexiblePart& b) {
  const Matrix& patterns = a.invariants.centrifugal_patterns();
  return a.sieve.Phi().cols() == b.sieve.Phi().cols() && a.sieve.Phi() == b.sieve.Phi() &&
         a.sieve.P() == b.sieve.P() && patterns == b.invariants.centrifugal_patterns();
}

}  // namespace

bool BodyStepOperator::fits(const body::FlexiblePart& part) const {
  return part.solver == part_->solver && are_equal(part.fe.M, part_->fe.M) &&
         are_equal(part.fe.K, part_->fe.K) && are_equal(part.C, part_->C);
}

bool BodyStepOperator::serves(const body::FlexiblePart& part) const {
  if (part.num_dofs() > kSmall || !fits(part)) return false;
  if (part.is_quasi_static != is_quasi_static_ || part.fe.mass_damping != part_->fe.mass_damping ||
      part.num_interface_rows != part_->num_interface_rows ||
      part.coupling.may_use_patterns() != part_->coupling.may_use_patterns()) {
    return false;
  }
  return have_same_rigid_modes(part, *part_) && are_equal(rows_of(part), N_);
}

BodyStepOperator::BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme,
                                   const FactorSource& source)
    : BodyAnswer(scheme, part.is_quasi_static),
      part_(&part),
      N_(rows_of(part)),
      inertial_(part, scheme) {
  {
    SparseMatrix K_hat = step_matrix(part, scheme);
    diagonal_ = K_hat.diagonal();
    if (is_division_enough(part, K_hat)) {
      diagonal_inverse_ = diagonal_.cwiseInverse();
    } else {
      find_factor(std::move(K_hat), source);
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
    D_less_G_ = inertia - interface;
  }
  compliance_ = N_ * G_;
  interface_ = compliance_.topLeftCorner(part.num_interface_rows, part.num_interface_rows);
  correction_ = Matrix::Zero(compliance_.rows(), compliance_.cols());
  if (scheme.weight == 1.0) correction_.leftCols(part.num_interface_rows) = N_ * D_less_G_;
  rigid_row_values_ = N_ * part.sieve.Phi();
  if (inverse_.size() > 0 && part.num_dofs() < N_.rows()) small_ = answers_by_variables();
}

SmallBodyAnswers BodyStepOperator::answers_by_variables() const {
  const Eigen::Index n = inverse_.rows();
  Matrix B = Matrix::Zero(n, n);
  if (scheme_.weight == 1.0) {  // as D − G in the constructor
    Matrix inertia = scheme_.mass * Matrix(part_->fe.M);
    if (part_->is_damped()) inertia += scheme_.damping * Matrix(part_->C);
    B = inverse_ * (inertia * inverse_) - inverse_;
  }
  return {N_, inverse_, std::move(B)};
}

SparseMatrix BodyStepOperator::K_hat() const { return step_matrix(*part_, scheme_); }

void BodyStepOperator::find_factor(SparseMatrix K_hat, const FactorSource& source) {
  const BodyStepOperator* twin = source.twin;
  if (twin != nullptr && twin->factor_ && have_one_matrix(scheme_, twin->scheme_) &&
      twin->fits(*part_)) {
    factor_ = twin->factor_;
    why_solver_ = twin->why_solver_;
    is_shared_ = true;
    return;
  }
  const body::SolverDecision decision = body::decide_solver(part_->solver, K_hat);
  why_solver_ = decision.why;
  if (decision.iterates) {
    factor_ = body::make_iterative(*part_, std::move(K_hat));
  } else if (source.exchange != nullptr) {
    const long factorisations = source.exchange->num_factorisations();
    factor_ = source.exchange->factor(K_hat);
    is_shared_ = source.exchange->num_factorisations() == factorisations;
  } else {
    factor_ = source.make(K_hat);
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

void BodyStepOperator::solve_right_side(Vector& x, TaskPool* pool) {
  if (is_diagonal()) {
    x = x.cwiseProduct(diagonal_inverse_);
  } else if (inverse_.size() > 0) {
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kSmall, 1> side = x;
    x.noalias() = inverse_ * side;
  } else {
    factor_->solve_in_place(x, pool);
  }
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

void BodyStepOperator::add_answer(const Eigen::VectorXd& load, Eigen::Index first,
                                  Eigen::Ref<Vector> piece) const {
  // Patterns carry no load without coupling.
  const Eigen::Index interface = num_interface_rows();
  const bool uses_patterns = !load.tail(load.size() - interface).isZero(0.0);
  const Eigen::Index columns = uses_patterns ? load.size() : interface;
  piece.noalias() +=
      (scheme_.force * G_.block(first, 0, piece.size(), columns)) * load.head(columns);
}

void BodyStepOperator::add_correction(const Eigen::VectorXd& e, Eigen::Index first,
                                      Eigen::Ref<Vector> piece) const {
  const Eigen::Index columns = num_interface_rows();
  piece.noalias() += G_.block(first, 0, piece.size(), columns) * e.head(columns);
}

void BodyStepOperator::add_correction_answer(const Eigen::VectorXd& e, Eigen::Index first,
                                             Eigen::Ref<Vector> piece) const {
  if (D_less_G_.cols() == 0) return;
  piece.noalias() += D_less_G_.middleRows(first, piece.size()) * e.head(D_less_G_.cols());
}

void BodyStepOperator::row_values(const model::BodyState& state, Vector& y, Vector& y_dot,
                                  Vector& y_ddot, Vector& y_alg, TaskPool* pool) const {
  if (!small_.empty()) {
    small_.row_values(state.d, y);
    small_.row_values(state.d_dot, y_dot);
    small_.row_values(state.d_ddot, y_ddot);
    small_.row_values(state.d_alg, y_alg);
    return;
  }
  for (Vector* values : {&y, &y_dot, &y_ddot, &y_alg}) values->setZero(N_.rows());
  for (int row = 0; row < num_interface_rows(); ++row) {
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
  const Matrix* columns = patterns();
  if (columns == nullptr || !state.terms.use_patterns()) return;
  using Values = Eigen::Matrix<double, 6, 4>;
  const linalg::RowParts rows(num_dofs());
  std::array<Values, linalg::RowParts::kMostParts> sums;
  std::fill_n(sums.begin(), rows.count(), Values::Zero());
  rows.for_pieces(pool, [&](int part, Eigen::Index first, Eigen::Index size) {
    Values& sum = sums[static_cast<std::size_t>(part)];
    const auto piece = columns->middleRows(first, size).transpose();
    sum.col(0).noalias() += piece * state.d.segment(first, size);
    sum.col(1).noalias() += piece * state.d_dot.segment(first, size);
    sum.col(2).noalias() += piece * state.d_ddot.segment(first, size);
    sum.col(3).noalias() += piece * state.d_alg.segment(first, size);
  });
  Values whole = sums[0];
  for (int part = 1; part < rows.count(); ++part) whole += sums[static_cast<std::size_t>(part)];
  y.tail<6>() = whole.col(0);
  y_dot.tail<6>() = whole.col(1);
  y_ddot.tail<6>() = whole.col(2);
  y_alg.tail<6>() = whole.col(3);
}

}  // namespace buckens::stepping
