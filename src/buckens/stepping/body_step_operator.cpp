// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step_operator.h"

#include <vector>

namespace buckens::stepping {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

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

}  // namespace

BodyStepOperator::BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme)
    : part_(&part),
      scheme_(scheme),
      K_hat_(step_matrix(part, scheme)),
      factor_(K_hat_),
      N_(rows_of(part)) {
  const Matrix loads = Matrix(SparseMatrix(N_.transpose()));
  G_ = factor_.solve(loads);
  part.sieve.apply(G_);
  setup_solves_ += loads.cols();
  if (scheme.weight == 1.0) {
    // The strain answers the corrected position, the inertia does not: FM (37) with x⁺ shifted by
    // G e leaves Y K̂⁻¹ (m M + c C) G e.
    const Matrix interface = G_.leftCols(part.num_interface_rows);
    Matrix inertia = scheme.mass * (part.fe.M * interface);
    if (part.is_damped()) inertia += scheme.damping * (part.C * interface);
    Matrix answer = factor_.solve(inertia);
    part.sieve.apply(answer);
    D_ = Matrix::Zero(G_.rows(), G_.cols());
    D_.leftCols(interface.cols()) = answer;
    setup_solves_ += inertia.cols();
  } else {
    D_ = G_;
  }
  NG_ = N_ * G_;
  interface_ = NG_.topLeftCorner(part.num_interface_rows, part.num_interface_rows);
  ND_ = N_ * D_;
}

void BodyStepOperator::free_response(const model::BodyState& before, const History<Vector>& history,
                                     const Vector& load, Vector& free) {
  // With x₀ = x + offset:  K̂ x_e = c θ F + M (m x₀ − cθ ẍ₀) + C (d x₀ − cθ ẋ₀),
  // x⁺ = x + (x_e − x₀)/θ.
  const double c_theta = scheme_.force * scheme_.weight;
  scratch_ = scheme_.mass * before.d - c_theta * history.acceleration;
  if (scheme_.has_offset()) scratch_ += scheme_.mass * history.offset;
  right_side_.noalias() = part_->fe.M * scratch_;
  if (part_->is_damped()) {
    scratch_ = scheme_.damping * before.d - c_theta * history.mean_velocity;
    if (scheme_.has_offset()) scratch_ += scheme_.damping * history.offset;
    right_side_.noalias() += part_->C * scratch_;
  }
  if (load.size() > 0) right_side_ += c_theta * load;
  free = right_side_;
  factor_.solve_in_place(free);
  ++solves_;
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
  factor_.solve_in_place(x);
  part_->sieve.apply(x);
  ++setup_solves_;
}

void BodyStepOperator::complete(const Vector& load, const Vector& correction, Vector& x) const {
  x.noalias() += G_ * (scheme_.force * load);
  if (!correction.isZero(0.0)) x.noalias() += D_ * correction;
}

}  // namespace buckens::stepping
