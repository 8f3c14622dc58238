// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step_operator.h"

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

}  // namespace

BodyStepOperator::BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme)
    : part_(&part),
      scheme_(scheme),
      K_hat_(step_matrix(part, scheme)),
      factor_(K_hat_),
      N_(part.rows.topRows(part.num_interface_rows)) {
  const Matrix loads = Matrix(SparseMatrix(N_.transpose()));
  G_ = factor_.solve(loads);
  part.sieve.apply(G_);
  setup_solves_ += loads.cols();
  if (scheme.weight == 1.0) {
    // The strain answers the corrected position, the inertia does not: FM (37) with x⁺ shifted by
    // G e leaves Y K̂⁻¹ (m M + c C) G e.
    Matrix inertia = scheme.mass * (part.fe.M * G_);
    if (part.is_damped()) inertia += scheme.damping * (part.C * G_);
    D_ = factor_.solve(inertia);
    part.sieve.apply(D_);
    setup_solves_ += inertia.cols();
  } else {
    D_ = G_;
  }
  if (part.coupling == body::CouplingLevel::full) {
    Gc_ = factor_.solve(part.invariants.centrifugal_patterns());
    part.sieve.apply(Gc_);
    setup_solves_ += Gc_.cols();
  } else {
    Gc_ = Matrix::Zero(part.num_dofs(), 6);
  }
  NG_ = N_ * G_;
  ND_ = N_ * D_;
  NGc_ = N_ * Gc_;
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

void BodyStepOperator::complete(const Vector& interface_load,
                                const Eigen::Matrix<double, 6, 1>& centrifugal,
                                const Vector& correction, Vector& x) const {
  x.noalias() += G_ * (scheme_.force * interface_load);
  if (part_->coupling == body::CouplingLevel::full) {
    x.noalias() += Gc_ * (scheme_.force * centrifugal);
  }
  if (!correction.isZero(0.0)) x.noalias() += D_ * correction;
}

}  // namespace buckens::stepping
