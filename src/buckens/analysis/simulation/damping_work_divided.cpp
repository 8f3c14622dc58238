// SPDX-License-Identifier: Apache-2.0
// The work of dampers where other processes have the rows of a body's vectors.
#include <optional>
#include <utility>
#include <vector>

#include "buckens/analysis/simulation/damping_work.h"
#include "buckens/dynamics/coupling_terms.h"

namespace buckens::analysis {

using linalg::DividedVector;
using linalg::RowProgram;
using linalg::Vector;

namespace {

using WeightedVectors = std::vector<std::pair<double, const DividedVector*>>;

DividedVector mass_times(RowProgram& program, const body::FlexiblePart& part,
                         const DividedVector& x) {
  return part.nodal_motion != nullptr ? program.multiply_mass(x)
                                      : program.multiply(part.fe.M.divide(), x);
}

/// ḋᵀM ḋ, if there is mass damping.
std::optional<RowProgram::Sums> inner_product_by_mass(RowProgram& program,
                                                      const body::FlexiblePart& part,
                                                      const DividedVector& rate) {
  if (part.fe.mass_damping == 0.0) return std::nullopt;
  return program.inner_product(rate, mass_times(program, part, rate));
}

/// α ḋᵀM ḋ [W]
double power_by_mass(const RowProgram& program, const body::FlexiblePart& part,
                     const std::optional<RowProgram::Sums>& of_rates) {
  return of_rates ? part.fe.mass_damping * program.sum(*of_rates)[0] : 0.0;
}

}  // namespace

/// Of loads on the nodes: along the centrifugal patterns, and along the rows of interfaces.
struct DampingWork::Columns {
  Columns(std::shared_ptr<linalg::DividedVectors> vectors, const body::FlexiblePart& part)
      : of(std::move(vectors)) {
    for (int k = 0; k < 6; ++k) {
      Vector load = Vector::Zero(part.num_dofs());
      part.invariants.add_centrifugal_load(Eigen::Matrix<double, 6, 1>::Unit(k), load);
      patterns.push_back(of->put(load));
    }
    for (int row = 0; row < part.num_interface_rows; ++row) {
      rows.push_back(of->put(part.rows.row(row).transpose()));
    }
  }

  std::shared_ptr<linalg::DividedVectors> of;
  std::vector<DividedVector> patterns, rows;
};

const DampingWork::Columns& DampingWork::columns(
    const std::shared_ptr<linalg::DividedVectors>& of) {
  if (!columns_ || columns_->of != of) {
    columns_ = std::make_shared<const Columns>(of, *body_->flexible);
  }
  return *columns_;
}

void DampingWork::begin_there(const model::BodyState& s,
                              const std::shared_ptr<linalg::DividedVectors>& of) {
  if (is_direct_) {
    rates_ = s.d_dot;
    return;
  }
  const body::FlexiblePart& part = *body_->flexible;
  const DividedVector d = s.d.divided(of), rate = s.d_dot.divided(of);
  RowProgram program(*of);
  const DividedVector elastic = program.multiply(part.fe.K.divide(), d);
  const auto of_rates = inner_product_by_mass(program, part, rate);
  program.run();
  power_ = power_by_mass(program, part, of_rates);
  d_ = s.d;
  elastic_ = linalg::NodalVector(of, elastic);
  last_step_ = 0.0;
  ++products_;
}

double DampingWork::direct_work_there(const linalg::NodalVector& d_dot, double h,
                                      const std::shared_ptr<linalg::DividedVectors>& of) {
  const DividedVector before = rates_.divided(of), after = d_dot.divided(of);
  RowProgram program(*of);
  const DividedVector mean = program.combine(WeightedVectors{{0.5, &before}, {0.5, &after}});
  const auto product =
      program.inner_product(mean, program.multiply(body_->flexible->C.divide(), mean));
  program.run();
  rates_ = d_dot;
  ++products_;
  return h * program.sum(product)[0];
}

double DampingWork::work_there(const model::State& state, const dynamics::Forces& forces,
                               bool is_formed, double h,
                               const std::shared_ptr<linalg::DividedVectors>& of) {
  const body::FlexiblePart& part = *body_->flexible;
  const model::BodyState& s = state.bodies[index_];
  const DividedVector d = s.d.divided(of), rate = s.d_dot.divided(of);
  const DividedVector d_before = d_.divided(of), elastic_before = elastic_.divided(of);
  RowProgram program(*of);
  DividedVector elastic;
  if (is_formed) {
    elastic = program.multiply(part.fe.K.divide(), d);
    ++products_;
  } else {
    elastic = elastic_load_there(state, forces, h, columns(of), program);
  }
  const DividedVector motion = program.combine(WeightedVectors{{1.0, &d}, {-1.0, &d_before}});
  const auto after = program.inner_product(motion, elastic);
  const auto before = program.inner_product(motion, elastic_before);
  const auto of_rates = inner_product_by_mass(program, part, rate);
  program.run();
  const double power = power_by_mass(program, part, of_rates);
  const double stiffness = beta_ / h * (program.sum(after)[0] - program.sum(before)[0]);
  const double work = 0.5 * h * (power_ + power) + stiffness;
  d_ = s.d;
  linalg::NodalVector now(of, elastic);
  go_on(now, power, is_formed ? 0.0 : h);
  return work;
}

/// See find_elastic_load().
DividedVector DampingWork::elastic_load_there(const model::State& state,
                                              const dynamics::Forces& forces, double h,
                                              const Columns& columns, RowProgram& program) {
  const body::FlexiblePart& part = *body_->flexible;
  const model::BodyState& s = state.bodies[index_];
  const bool knows = knows_rate(h);
  const DividedVector acceleration = s.d_ddot.divided(columns.of);
  const DividedVector rate = s.d_dot.divided(columns.of);
  const DividedVector elastic = elastic_.divided(columns.of);
  DividedVector elastic_before, coupling;
  if (knows) elastic_before = elastic_before_.divided(columns.of);
  if (s.terms.have_load()) coupling = s.coupling.load.divided(columns.of);
  const DividedVector moving =
      program.combine(WeightedVectors{{1.0, &acceleration}, {part.fe.mass_damping, &rate}});
  const DividedVector inertia = mass_times(program, part, moving);

  const double s2 = (knows ? 0.5 : 1.0) * beta_ / h;
  const double share = 1.0 / (1.0 + (knows ? 3.0 : 1.0) * s2);
  WeightedVectors terms = {{-share, &inertia}};
  if (!coupling.empty()) terms.emplace_back(share, &coupling);
  const auto weights = dynamics::centrifugal_weights(s.terms, s.frame.w);
  for (std::size_t k = 0; k < columns.patterns.size(); ++k) {
    terms.emplace_back(share * weights[static_cast<int>(k)], &columns.patterns[k]);
  }
  const Vector& f = forces.interface[index_];
  for (std::size_t k = 0; k < columns.rows.size(); ++k) {
    terms.emplace_back(share * f[static_cast<Eigen::Index>(k)], &columns.rows[k]);
  }
  terms.emplace_back(share * (knows ? 4.0 : 1.0) * s2, &elastic);
  if (knows) terms.emplace_back(-share * s2, &elastic_before);
  return program.combine(terms);
}

}  // namespace buckens::analysis
