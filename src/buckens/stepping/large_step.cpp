// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/large_step.h"

#include <algorithm>
#include <cmath>

#include "buckens/linalg/pseudo_inverse.h"

namespace buckens::stepping {

using Eigen::Index;
using Eigen::VectorXd;
using linalg::Vector;

namespace {
// Rows along which the body yields less than this share of what they yield alone are combinations
// of others.
constexpr double kDependentRow = 1e-9;
}  // namespace

LargeStep::LargeStep(BodyStepOperator& op)
    : op_(&op),
      rows_(op.num_dofs(), op.nodal() != nullptr ? 3 : 1),
      holds_at_end_(op.scheme().weight == 1.0),
      sums_(static_cast<std::size_t>(rows_.count())) {
  const Scheme& scheme = op.scheme();
  const auto of_rate = scheme.history(1.0, 0.0, 0.0);
  const auto of_acceleration = scheme.history(0.0, 1.0, 0.0);
  const auto of_algorithmic = scheme.history(0.0, 0.0, 1.0);
  const auto weights = [&](double History<double>::*member) -> Weights {
    return {0.0, of_rate.*member, of_acceleration.*member, of_algorithmic.*member};
  };
  velocity_ = weights(&History<double>::velocity);
  acceleration_ = weights(&History<double>::acceleration);
  mean_velocity_ = weights(&History<double>::mean_velocity);
  offset_ = weights(&History<double>::offset);
  const double c_theta = scheme.force * scheme.weight;
  const Weights start = Weights{1.0} + offset_;
  with_damping_ = start * scheme.damping + mean_velocity_ * -c_theta;
  with_mass_ = start * scheme.mass + acceleration_ * -c_theta;
  const InertialLoad& inertial = op.inertial();
  if (inertial.is_proportional()) with_mass_ = with_mass_ + with_damping_ * inertial.zeta();
  beside_solution_ = with_damping_ * inertial.share();
  from_start_ = Weights{1.0} + start * (-1.0 / scheme.weight);

  // What take_solution() makes of the solution, turned round.
  const Weights ahead{1.0, scheme.h, 0.5 * scheme.h * scheme.h};
  estimate_ = (holds_at_end_ ? ahead : (ahead + from_start_ * -1.0) * scheme.weight) +
              beside_solution_ * -1.0;
  carried_before_ = scheme.carried_acceleration(1.0, 0.0);
  carried_new_ = scheme.carried_acceleration(0.0, 1.0);
  algorithmic_before_ = scheme.algorithmic(1.0, 0.0, 0.0);
  algorithmic_old_ = scheme.algorithmic(0.0, 1.0, 0.0);
  algorithmic_new_ = scheme.algorithmic(0.0, 0.0, 1.0);
}

void LargeStep::form_right_side(const model::BodyState& before, const linalg::NodalVector& of_load,
                                TaskPool* pool) {
  is_first_ = true;
  if (is_divided()) return form_divided_right_side(before, of_load);
  const Vector& load = of_load.whole();
  const InertialLoad& inertial = op_->inertial();
  const bool is_damped_otherwise = inertial.is_damped() && !inertial.is_proportional();
  scratch_.resize(rows_.rows());
  if (is_damped_otherwise) damped_.resize(rows_.rows());
  const Start start(before);
  rows_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
    scratch_.segment(first, size) = combination(with_mass_, start, first, size);
    if (!is_damped_otherwise) return;
    damped_.segment(first, size) = combination(with_damping_, start, first, size);
  });
  const double c_theta = op_->scheme().force * op_->scheme().weight;
  const auto add_load = [&](int /*part*/, Index first, Index size) {
    if (load.size() > 0) free_.segment(first, size) += c_theta * load.segment(first, size);
  };
  if (op_->nodal() != nullptr && inertial.is_by_node() && !is_damped_otherwise) {
    free_.resize(rows_.rows());
    op_->common().for_pieces(rows_, pool, [&](int part, Index first, Index size) {
      op_->nodal()->multiply_mass(first, size, scratch_, free_);
      add_load(part, first, size);
    });
    return;
  }
  if (is_damped_otherwise) {
    inertial.multiply(scratch_, damped_, free_, pool);
  } else {
    inertial.multiply_mass(scratch_, free_, pool);
  }
  if (load.size() > 0) rows_.for_pieces(pool, add_load);
}

void LargeStep::form_right_side_of_change(const linalg::NodalVector& load_before,
                                          const linalg::NodalVector& load_after, TaskPool* pool) {
  is_first_ = false;
  if (is_divided()) return form_divided_change(load_before, load_after);
  const Vector &before = load_before.whole(), &after = load_after.whole();
  change_.resize(rows_.rows());
  rows_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
    change_.segment(first, size) =
        op_->scheme().force * (after.segment(first, size) - before.segment(first, size));
  });
}

void LargeStep::sieve_side() { op_->sieve().apply_transposed(side()); }

void LargeStep::estimate_solution(const model::BodyState& before, Vector& x) {
  x = combination(estimate_, Start(before), 0, rows_.rows());
  const linalg::Matrix& G = op_->responses();
  if (G.cols() == 0) return;
  if (loads_of_N_.size() == 0) {
    // On a scale on which rows of any unit count alike.
    const linalg::Matrix& compliance = op_->compliance();
    const VectorXd scale = compliance.diagonal().unaryExpr(
        [](double of_row) { return of_row > 0.0 ? 1.0 / std::sqrt(of_row) : 0.0; });
    linalg::PseudoInverse scaled(kDependentRow);
    scaled.compute(scale.asDiagonal() * compliance * scale.asDiagonal());
    loads_of_N_ = scale.asDiagonal() * scaled.whole() * scale.asDiagonal();
  }
  // Least energy of the error: Gᵀ(b − K̂ (x + G a)) = 0 with K̂ G = Yᵀ Nᵀ.
  const VectorXd misfit = G.transpose() * free_ - op_->row_values(x);
  const VectorXd load = loads_of_N_ * misfit;
  x.noalias() += G * load;
}

void LargeStep::iterate(const model::BodyState& before, const linalg::Factor& factor) {
  if (is_first_) {
    estimate_solution(before, iterated_);
    factor.improve(free_, iterated_, 0.0);
    energy_ = std::sqrt(std::max(0.0, free_.dot(iterated_)));
    free_.swap(iterated_);
  } else {
    iterated_.setZero(rows_.rows());
    factor.improve(change_, iterated_, energy_);
    change_.swap(iterated_);
  }
}

void LargeStep::clear_sums() {
  for (PartSums& sums : sums_) {
    sums.rigid.setZero(op_->sieve().rank());
    sums.patterns.setZero();
    sums.nodal_rigid = sums.nodal_patterns = {};
    sums.total = 0.0;
  }
}

void LargeStep::add_rigid(Index first, Index size, const Vector& x, PartSums& sums) {
  if (op_->nodal() != nullptr) {
    op_->nodal()->add_moments(first, size, x, sums.nodal_rigid);
  } else {
    const auto P = op_->sieve().stored_P().middleRows(first, size);
    sums.rigid.noalias() += P.transpose() * x.segment(first, size);
  }
}

void LargeStep::add_patterns(Index first, Index size, PartSums& sums) {
  if (op_->nodal() != nullptr) {
    op_->nodal()->add_moments(first, size, free_, sums.nodal_patterns);
  } else {
    const auto patterns = op_->stored_patterns().middleRows(first, size);
    sums.patterns.noalias() += patterns.transpose() * free_.segment(first, size);
  }
}

void LargeStep::pass_solution(const model::BodyState& before, bool uses_patterns, bool has_both,
                              TaskPool* pool) {
  const Scheme& scheme = op_->scheme();
  const bool adds = op_->inertial().share() != 0.0;
  const bool at_evaluation = scheme.has_offset();
  clear_sums();
  const Start start(before);
  rows_.for_pieces(pool, [&](int part, Index first, Index size) {
    PartSums& sums = sums_[static_cast<std::size_t>(part)];
    auto x = free_.segment(first, size);
    if (is_first_) {
      if (adds) x += combination(beside_solution_, start, first, size);
      if (at_evaluation) add_rigid(first, size, free_, sums);
      if (!holds_at_end_) x = x / scheme.weight + combination(from_start_, start, first, size);
      if (!at_evaluation) add_rigid(first, size, free_, sums);
    } else {
      add_rigid(first, size, change_, sums);
      x += change_.segment(first, size);
    }
    if (uses_patterns && !has_both) add_patterns(first, size, sums);
  });
  for (PartSums& sums : sums_) {
    if (op_->nodal() == nullptr) continue;
    sums.rigid = op_->nodal()->rigid(sums.nodal_rigid);
    sums.patterns = body::NodalMotion::patterns(has_both ? sums.nodal_rigid : sums.nodal_patterns);
  }
}

void LargeStep::take_solution(const model::BodyState& before, VectorXd& y_free, TaskPool* pool) {
  const Scheme& scheme = op_->scheme();
  const bool uses_patterns = before.terms.use_patterns() && op_->has_patterns();
  // Wilson's motion is sieved where the equations hold: at the end of the step the rule of linear
  // acceleration would let a rigid part of the rates, rounding at first, grow by 2 + √3 per step.
  const bool at_evaluation = scheme.has_offset();
  // Of a solid the same moments give rigid motion and patterns, and those of a change add to those
  // of the whole.
  const bool has_both = op_->nodal() != nullptr && !(is_first_ && at_evaluation);
  if (is_first_) rigid_.setZero(op_->sieve().rank());
  if (is_first_ || !has_both) pattern_values_.setZero();
  const double scale = is_first_ && at_evaluation ? 1.0 / scheme.weight : 1.0;
  const auto add = [&](const auto& sums) {
    rigid_ += scale * sums.rigid;
    pattern_values_ += sums.patterns;
  };
  const Index interface = op_->num_interface_rows();
  y_free.setZero(op_->num_rows());
  if (is_divided()) {
    const SolutionSums sums = take_divided_solution(before, uses_patterns, has_both);
    add(sums);
    y_free.head(interface) = sums.interface;
  } else {
    pass_solution(before, uses_patterns, has_both, pool);
    for (const PartSums& sums : sums_) add(sums);
    y_free.head(interface).noalias() += op_->interface_rows() * free_;
  }
  if (uses_patterns) y_free.tail<6>() = pattern_values_;
  const Index used = uses_patterns ? y_free.size() : interface;
  y_free.head(used).noalias() -= op_->rigid_row_values().topRows(used) * rigid_;
}

void LargeStep::form_end(const Start& before, Index first, Index size, const End& after) {
  const Scheme& scheme = op_->scheme();
  const auto increment = after.d_alg.segment(first, size);
  if (op_->is_quasi_static()) {
    after.d_dot.segment(first, size).setZero();
    after.d_ddot.segment(first, size).setZero();
  } else {
    after.d_dot.segment(first, size) =
        scheme.end_rate * increment + combination(velocity_, before, first, size);
    after.d_ddot.segment(first, size) =
        scheme.acceleration_rate * increment + combination(acceleration_, before, first, size);
  }
  if (!holds_at_end_) {
    after.d_e->segment(first, size) =
        scheme.weight * increment + combination(Weights{1.0} + offset_, before, first, size);
    after.rate_e->segment(first, size) =
        scheme.mean_rate * increment + combination(mean_velocity_, before, first, size);
    if (op_->is_quasi_static()) after.rate_e->segment(first, size).setZero();
    after.acceleration_e->segment(first, size) = after.d_ddot.segment(first, size);
    after.d_ddot.segment(first, size) = carried_new_ * after.acceleration_e->segment(first, size) +
                                        carried_before_ * before.d_ddot.segment(first, size);
  }
  after.d_alg.segment(first, size) = algorithmic_new_ * after.d_ddot.segment(first, size) +
                                     algorithmic_before_ * before.d_ddot.segment(first, size) +
                                     algorithmic_old_ * before.d_alg.segment(first, size);
}

void LargeStep::complete(const model::BodyState& before, const VectorXd& load,
                         const VectorXd& correction, model::BodyState& after, TaskPool* pool) {
  if (is_divided()) return complete_divided(before, load, correction, after);
  const Index n = rows_.rows();
  const Start start(before);
  End end(after, n);
  if (!holds_at_end_) {
    end.d_e = &d_e_.overwrite(n);
    end.rate_e = &rate_e_.overwrite(n);
    end.acceleration_e = &acceleration_e_.overwrite(n);
  }
  const linalg::Matrix& Phi = op_->sieve().stored_Phi();
  const body::NodalMotion* nodal = op_->nodal();
  const Eigen::Matrix4d motion =
      nodal != nullptr ? nodal->motion(rigid_) : Eigen::Matrix4d(Eigen::Matrix4d::Zero());
  const bool corrects = !correction.isZero(0.0);
  clear_sums();
  op_->common().for_pieces(rows_, pool, [&](int part, Index first, Index size) {
    auto increment = end.d_alg.segment(first, size);  // until it is assigned
    increment = free_.segment(first, size) - start.d.segment(first, size);
    if (nodal != nullptr) {
      nodal->subtract(first, size, motion, end.d_alg);
    } else if (rigid_.size() > 0) {
      increment.noalias() -= Phi.middleRows(first, size) * rigid_;
    }
    op_->add_answer(load, first, increment);
    if (corrects) op_->add_correction_answer(correction, first, increment);
    auto d = end.d.segment(first, size);
    d = start.d.segment(first, size) + increment;
    if (corrects) op_->add_correction(correction, first, d);
    form_end(start, first, size, end);
    // Not finite as soon as one of them is not.
    sums_[static_cast<std::size_t>(part)].total +=
        d.sum() + end.d_dot.segment(first, size).sum() + end.d_ddot.segment(first, size).sum();
  });
  is_finite_ = true;
  for (const PartSums& sums : sums_) is_finite_ = is_finite_ && std::isfinite(sums.total);
}

}  // namespace buckens::stepping
