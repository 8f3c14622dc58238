// SPDX-License-Identifier: Apache-2.0
// The n-sized part of a step where other processes have the rows of its vectors.
#include <array>
#include <cmath>
#include <vector>

#include "buckens/stepping/large_step.h"

namespace buckens::stepping {

using Eigen::Index;
using Eigen::VectorXd;
using linalg::DividedVector;
using linalg::NodalVector;
using linalg::RowProgram;

namespace {

using WeightedVectors = std::vector<std::pair<double, const DividedVector*>>;

/// Adds factor × weights × columns.
void add_columns(const std::vector<DividedVector>& columns, const VectorXd& weights, double factor,
                 WeightedVectors& terms) {
  for (Index k = 0; k < weights.size(); ++k) {
    terms.emplace_back(factor * weights[k], &columns[static_cast<std::size_t>(k)]);
  }
}

}  // namespace

/// Vectors at the start of a step.
struct LargeStep::Past {
  Past(const DividedBody& body, const model::BodyState& s)
      : vectors{body.of(s.d), body.of(s.d_dot), body.of(s.d_ddot), body.of(s.d_alg)} {}

  const DividedVector& d() const { return vectors[0]; }
  const DividedVector& acceleration() const { return vectors[2]; }
  const DividedVector& algorithmic() const { return vectors[3]; }
  void add(const Weights& w, WeightedVectors& terms) const {
    const std::array<double, 4> weights = {w.d, w.rate, w.acceleration, w.algorithmic};
    for (std::size_t k = 0; k < 4; ++k) terms.emplace_back(weights[k], &vectors[k]);
  }

  std::array<DividedVector, 4> vectors;
};

void LargeStep::form_divided_right_side(const model::BodyState& before, const NodalVector& load) {
  const DividedBody& body = *op_->divided();
  const Past past(body, before);
  const DividedVector of_load = load.size() > 0 ? body.of(load) : DividedVector();
  WeightedVectors terms;
  past.add(with_mass_, terms);
  RowProgram program(body.vectors());
  const DividedVector moving = program.combine(terms);
  free_there_ = body.multiply_mass(program, moving);
  const InertialLoad& inertial = op_->inertial();
  if (inertial.is_damped() && !inertial.is_proportional()) {
    WeightedVectors damped;
    past.add(with_damping_, damped);
    const DividedVector of_damping = body.multiply_damping(program, program.combine(damped));
    program.add(free_there_, WeightedVectors{{1.0, &of_damping}});
  }
  const double c_theta = op_->scheme().force * op_->scheme().weight;
  if (!of_load.empty()) program.add(free_there_, WeightedVectors{{c_theta, &of_load}});
  program.run();
}

void LargeStep::form_divided_change(const NodalVector& before, const NodalVector& after) {
  const DividedBody& body = *op_->divided();
  const DividedVector first = body.of(before);
  const DividedVector second = body.of(after);
  const double force = op_->scheme().force;
  RowProgram program(body.vectors());
  change_there_ = program.combine(WeightedVectors{{force, &second}, {-force, &first}});
  program.run();
}

void LargeStep::solve_divided(const linalg::Factor& factor) {
  DividedVector& side = is_first_ ? free_there_ : change_there_;
  side = factor.solve_divided(op_->divided()->vectors(), side);
}

linalg::RecycledSolves::DividedLoad LargeStep::divided_side() {
  const DividedBody& body = *op_->divided();
  return {&body.vectors(), is_first_ ? &free_there_ : &change_there_, &body.scale()};
}

LargeStep::SolutionSums LargeStep::take_divided_solution(const model::BodyState& before,
                                                         bool uses_patterns, bool has_both) {
  const DividedBody& body = *op_->divided();
  const Past past(body, before);
  const bool at_evaluation = op_->scheme().has_offset();
  RowProgram program(body.vectors());
  RowProgram::Sums rigid, patterns;
  if (is_first_) {
    if (op_->inertial().share() != 0.0) {
      WeightedVectors terms;
      past.add(beside_solution_, terms);
      program.add(free_there_, terms);
    }
    if (at_evaluation) rigid = program.moments(free_there_);
    if (!holds_at_end_) {
      WeightedVectors terms = {{1.0 / op_->scheme().weight, &free_there_}};
      past.add(from_start_, terms);
      free_there_ = program.combine(terms);
    }
    if (!at_evaluation) rigid = program.moments(free_there_);
  } else {
    rigid = program.moments(change_there_);
    program.add(free_there_, WeightedVectors{{1.0, &change_there_}});
  }
  if (uses_patterns && !has_both) patterns = program.moments(free_there_);
  const RowProgram::Sums products = program.row_products({&free_there_});
  program.run();

  SolutionSums out;
  const linalg::Vector of_rigid = program.sum(rigid);
  out.rigid = body.rigid(of_rigid).head(op_->sieve().rank());
  if (uses_patterns) out.patterns = body.patterns(has_both ? of_rigid : program.sum(patterns));
  out.interface = program.sum(products).head(op_->num_interface_rows());
  return out;
}

void LargeStep::complete_divided(const model::BodyState& before, const VectorXd& load,
                                 const VectorXd& correction, model::BodyState& after) {
  const DividedBody& body = *op_->divided();
  const Scheme& scheme = op_->scheme();
  const Past past(body, before);
  const bool corrects = !correction.isZero(0.0);
  RowProgram program(body.vectors());
  const DividedVector increment =
      program.combine(WeightedVectors{{1.0, &free_there_}, {-1.0, &past.d()}});
  program.subtract(increment, body.motion(rigid_).data());
  WeightedVectors answers;
  add_columns(body.G(), load, scheme.force, answers);
  const VectorXd closing = correction.head(op_->num_interface_rows());
  if (corrects && !body.D_less_G().empty()) add_columns(body.D_less_G(), closing, 1.0, answers);
  program.add(increment, answers);

  const auto combine = [&](double of_increment, const Weights& of_past) {
    WeightedVectors terms = {{of_increment, &increment}};
    past.add(of_past, terms);
    return program.combine(terms);
  };
  const DividedVector d = combine(1.0, Weights{1.0});
  if (corrects) {
    WeightedVectors closed;
    add_columns(body.G(), closing, 1.0, closed);
    program.add(d, closed);
  }
  const DividedVector rate = combine(scheme.end_rate, velocity_);
  DividedVector acceleration = combine(scheme.acceleration_rate, acceleration_);
  if (!holds_at_end_) {
    d_e_ = body.nodal(combine(scheme.weight, Weights{1.0} + offset_));
    rate_e_ = body.nodal(combine(scheme.mean_rate, mean_velocity_));
    acceleration_e_ = body.nodal(acceleration);
    acceleration = program.combine(
        WeightedVectors{{carried_new_, &acceleration}, {carried_before_, &past.acceleration()}});
  }
  const DividedVector algorithmic =
      program.combine(WeightedVectors{{algorithmic_new_, &acceleration},
                                      {algorithmic_before_, &past.acceleration()},
                                      {algorithmic_old_, &past.algorithmic()}});
  const RowProgram::Sums total = program.total({&d, &rate, &acceleration});
  program.run();
  is_finite_ = std::isfinite(program.sum(total)[0]);
  after.d = body.nodal(d);
  after.d_dot = body.nodal(rate);
  after.d_ddot = body.nodal(acceleration);
  after.d_alg = body.nodal(algorithmic);
}

}  // namespace buckens::stepping
