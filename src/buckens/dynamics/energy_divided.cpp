// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/energy_divided.h"

#include "buckens/body/deformation_coupling.h"
#include "buckens/body/nodal_motion.h"
#include "buckens/linalg/row_program.h"

namespace buckens::dynamics {

using linalg::DividedVector;
using linalg::RowProgram;

KineticTerms kinetic_terms(const body::CouplingTerms& terms) {
  body::CouplingTerms inertial = terms;
  inertial.stiffening = false;  // a load, no inertia
  if (inertial == body::CouplingTerms::none()) return KineticTerms::none;
  if (inertial == body::CouplingTerms::first_order()) return KineticTerms::first_order;
  return KineticTerms::all;
}

DeformationEnergy deformation_energy(const body::Body& body, const model::BodyState& state,
                                     const std::shared_ptr<linalg::DividedVectors>& of) {
  const body::FlexiblePart& part = *body.flexible;
  const bool is_by_node = part.nodal_motion != nullptr;
  const KineticTerms terms = kinetic_terms(state.terms);
  const DividedVector d = state.d.divided(of), rate = state.d_dot.divided(of);
  RowProgram program(*of);
  const DividedVector momenta =
      is_by_node ? program.multiply_mass(rate) : program.multiply(part.fe.M.divide(), rate);
  const RowProgram::Sums kinetic = program.inner_product(rate, momenta);
  const RowProgram::Sums strain = program.inner_product(d, program.multiply(part.fe.K.divide(), d));
  RowProgram::Sums linear, quadratic;
  if (terms != KineticTerms::none) linear = program.moments(d);
  if (terms == KineticTerms::all) quadratic = program.couple(d, rate, rate, nullptr).sums;
  program.run();

  DeformationEnergy out;
  out.kinetic = 0.5 * program.sum(kinetic)[0];
  out.strain = 0.5 * program.sum(strain)[0];
  out.moments.J = body.J0;
  if (terms == KineticTerms::all) {
    const auto moments = body::deformed_moments(linalg::node_sums(program.sum(quadratic)));
    out.moments.J += moments.J;
    out.moments.l = moments.l;
  }
  if (terms != KineticTerms::none) {
    const linalg::Vector sums = program.sum(linear);
    const Eigen::Matrix<double, 6, 1> values =
        is_by_node ? body::NodalMotion::patterns(linalg::node_sums(sums))
                   : Eigen::Matrix<double, 6, 1>(sums.segment<6>(linalg::kPatternSums));
    out.moments.J += body::InertiaInvariants::linear_inertia(values);
  }
  return out;
}

}  // namespace buckens::dynamics
