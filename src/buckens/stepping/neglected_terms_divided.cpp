// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/neglected_terms_divided.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "buckens/body/deformation_coupling.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/frame_equation.h"

namespace buckens::stepping {

using body::CouplingTerms;
using body::DeformationWeights;
using Eigen::Vector3d;
using linalg::DividedVector;
using linalg::RowProgram;

namespace {

using LoadTerms = std::vector<std::pair<double, const DividedVector*>>;
using Weights6 = DividedBody::Vector6;

/// Of d, ḋ and d̈.
struct DeformationNow {
  DividedVector d, rate, acceleration;
};

/// Weights of the loads of coupling terms: of the deformation, and of the patterns.
struct CouplingWeights {
  DeformationWeights deformation;
  Weights6 patterns;

  static CouplingWeights of(const model::BodyState& s, const CouplingTerms& terms) {
    return {DeformationWeights::of_motion(s.frame.w, s.w_dot, terms),
            dynamics::centrifugal_weights(terms, s.frame.w)};
  }
  CouplingWeights operator-(const CouplingWeights& other) const {
    CouplingWeights out = *this;
    out.deformation.with_d -= other.deformation.with_d;
    out.deformation.with_rate -= other.deformation.with_rate;
    out.patterns -= other.patterns;
    return out;
  }
};

/// The load, and the sums of RowProgram::couple().
RowProgram::Coupled coupled_load(RowProgram& program, const DividedBody& there,
                                 const DeformationNow& of, const CouplingWeights& weights) {
  const Eigen::Matrix<double, 4, 6> columns = weights.deformation.by_columns();
  RowProgram::Coupled out = program.couple(
      of.d, of.rate, of.acceleration, weights.deformation.are_zero() ? nullptr : columns.data());
  if (out.load.empty()) out.load = program.combine({});
  there.add_patterns(program, out.load, weights.patterns);
  return out;
}

/// The same without a product with the mass if there is nothing to multiply.
DividedVector load_of(RowProgram& program, const DividedBody& there, const DeformationNow& of,
                      const CouplingWeights& weights) {
  if (!weights.deformation.are_zero()) return coupled_load(program, there, of, weights).load;
  DividedVector out = program.combine({});
  there.add_patterns(program, out, weights.patterns);
  return out;
}

/// √(Σ (Yᵀf)ᵢ²/K̂ᵢᵢ) of loads. Sieves them in place. @param resultants Φᵀf of each
template <std::size_t kLoads>
std::array<double, kLoads> sieved_norms(const DividedBody& there,
                                        const std::array<const DividedVector*, kLoads>& loads,
                                        const std::array<Weights6, kLoads>& resultants) {
  RowProgram program(there.vectors());
  const DividedVector& weights = there.inverse_diagonal();
  std::array<RowProgram::Sums, kLoads> sums;
  for (std::size_t k = 0; k < kLoads; ++k) {
    program.subtract_load(*loads[k], there.motion(resultants[k]).data());
    sums[k] = program.compare(*loads[k], *loads[k], weights, weights);
  }
  program.run();
  std::array<double, kLoads> out{};
  for (std::size_t k = 0; k < kLoads; ++k) out[k] = std::sqrt(program.sum(sums[k])[1]);
  return out;
}

Vector3d frame_torque(const body::Body& body, const model::BodyState& s, const CouplingTerms& kept,
                      const linalg::Vector& coupled, const std::array<Weights6, 2>& patterns) {
  const body::DeformedMoments moments = dynamics::frame_moments(
      body, kept, quadratic_moments(kept, coupled), patterns[0], patterns[1]);
  return dynamics::frame_inertia(body, moments, s.frame.w, s.w_dot, Vector3d::Zero()).head<3>();
}

}  // namespace

NeglectedSizes neglected_sizes(const body::Body& body, const DividedBody& there,
                               const model::BodyState& state, const CouplingTerms& kept,
                               const linalg::Vector* interface_load) {
  const body::FlexiblePart& part = *body.flexible;
  const DeformationNow of = {there.of(state.d), there.of(state.d_dot), there.of(state.d_ddot)};
  const auto used_weights = CouplingWeights::of(state, kept);
  RowProgram program(there.vectors());
  const RowProgram::Coupled neglected =
      coupled_load(program, there, of, CouplingWeights::of(state, {}) - used_weights);
  const DividedVector used = load_of(program, there, of, used_weights);
  const DividedVector inertia = there.multiply_mass(program, of.acceleration);
  DividedVector internal, applied;
  if (interface_load != nullptr) {
    applied = program.combine({});
    program.add_row_loads(applied, interface_load->head(part.num_interface_rows));
    internal = program.combine(LoadTerms{{1.0, &applied}, {1.0, &used}, {-1.0, &inertia}});
  } else {
    internal = there.elastic_load(program, part, of.d, of.rate);
    applied = program.combine(LoadTerms{{1.0, &inertia}, {1.0, &internal}, {-1.0, &used}});
  }
  const std::array<RowProgram::Sums, 2> patterns = {program.moments(of.d),
                                                    program.moments(of.rate)};
  const std::array<const DividedVector*, 4> loads = {&inertia, &internal, &applied,
                                                     &neglected.load};
  std::array<RowProgram::Sums, 4> of_loads;
  for (std::size_t k = 0; k < 4; ++k) of_loads[k] = program.resultants(*loads[k]);
  program.run();

  std::array<Weights6, 4> resultants;
  for (std::size_t k = 0; k < 4; ++k) resultants[k] = there.rigid(program.sum(of_loads[k]));
  const std::array<Weights6, 2> values = {there.patterns(program.sum(patterns[0])),
                                          there.patterns(program.sum(patterns[1]))};
  const linalg::Vector coupled = program.sum(neglected.sums);
  const std::array<double, 4> norms = sieved_norms(there, loads, resultants);
  return {norms[0], norms[1], norms[2], norms[3],
          frame_torque(body, state, {}, coupled, values) -
              frame_torque(body, state, kept, coupled, values)};
}

}  // namespace buckens::stepping
