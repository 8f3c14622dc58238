// SPDX-License-Identifier: Apache-2.0
// The inertial coupling where other processes have the rows of its vectors.
#include <cmath>
#include <vector>

#include "buckens/body/deformation_coupling.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/stepping/lagged_coupling.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::DividedVector;
using linalg::NodalVector;
using linalg::RowProgram;

void LaggedCoupling::extrapolate_divided(const model::BodyState& s, int history, double t) {
  const dynamics::Extrapolation plan = dynamics::extrapolation_of(s, history, t);
  used_.t = t;
  used_.moments = plan.moments;
  used_.load = linalg::NodalVector();
  if (s.coupling.load.size() == 0) return;
  std::vector<DividedVector> loads;
  std::vector<std::pair<double, const DividedVector*>> terms;
  for (std::size_t k = 0; k < plan.count; ++k) loads.push_back(divided_->of(plan.known[k]->load));
  for (std::size_t k = 0; k < plan.count; ++k) terms.emplace_back(plan.weights[k], &loads[k]);
  RowProgram program(divided_->vectors());
  used_.load = divided_->nodal(program.combine(terms));
  program.run();
}

LaggedCoupling::Sizes LaggedCoupling::evaluate_divided(const body::CouplingTerms& terms,
                                                       const NodalVector& d,
                                                       const NodalVector& rate,
                                                       const NodalVector& acceleration,
                                                       const Vector3d& w, const Vector3d& w_dot,
                                                       bool compares, model::Coupling& out) {
  out.t = 0;
  out.load = NodalVector();
  const bool has_load = terms.have_load();
  body::DeformationWeights weights;
  if (has_load) weights = body::DeformationWeights::of_motion(w, w_dot, terms);
  const bool is_pushed = !weights.are_zero();
  RowProgram program(divided_->vectors());
  DividedVector load;
  RowProgram::Sums moments, compared;
  if (terms.quad_ref || is_pushed) {
    const Eigen::Matrix<double, 4, 6> columns = weights.by_columns();
    auto coupled = program.couple(divided_->of(d), divided_->of(rate), divided_->of(acceleration),
                                  is_pushed ? columns.data() : nullptr);
    load = std::move(coupled.load);
    moments = coupled.sums;
  }
  if (has_load && !is_pushed) load = program.combine({});
  const DividedVector used = compares && has_load ? divided_->of(used_.load) : DividedVector();
  if (!used.empty()) {
    const DividedVector& per_load = divided_->inverse_diagonal();
    compared =
        program.compare(load, used, per_load, moved_there_.empty() ? per_load : moved_there_);
  }
  program.run();
  if (has_load) out.load = divided_->nodal(load);
  out.moments = quadratic_moments(terms, program.sum(moments));
  if (used.empty()) return {};
  const linalg::Vector sums = program.sum(compared);
  return {sums[0], sums[1], program.most(compared, 2)};
}

}  // namespace buckens::stepping
