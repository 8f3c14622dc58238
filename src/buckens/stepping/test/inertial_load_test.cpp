// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/inertial_load.h"

#include <array>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/inverse_iteration.h"

namespace buckens::stepping {
namespace {

using body::CouplingLevel;
using linalg::Vector;

fem::FeModel block(const std::array<int, 3>& divisions, double damping_stiffness = 0) {
  fem::Structure structure;
  fem::Box box;
  box.size = {1.0, 0.1, 0.1};
  box.divisions = divisions;
  fem::Material rubber = fem::Material::isotropic(1e8, 0.3, 1100);
  rubber.damping_mass = 0.3;
  rubber.damping_stiffness = damping_stiffness;
  fem::add_box(structure, box, rubber);
  return fem::assemble(structure);
}

/// K̂⁻¹ (M a + C b) by InertialLoad and densely.
void expect_right_load(const fem::FeModel& fe, bool is_proportional, bool is_by_node) {
  const body::FlexiblePart part("block", fe, CouplingLevel::full);
  const Scheme scheme(Method::generalized_alpha, 1e-3, 0.9);
  const InertialLoad inertial(part, scheme);
  EXPECT_EQ(inertial.is_proportional(), is_proportional);
  EXPECT_EQ(inertial.is_by_node(), is_by_node);
  const Vector a = linalg::scattered_block(part.num_dofs(), 1, 1);
  const Vector b = linalg::scattered_block(part.num_dofs(), 1, 2);
  const linalg::Matrix K_hat = scheme.mass * part.fe.M.whole() + scheme.damping * part.C.whole() +
                               scheme.stiffness * part.fe.K.whole();
  const Eigen::LDLT<linalg::Matrix> factor(K_hat);
  const Vector expected = factor.solve(part.fe.M * a + part.C * b);
  Vector right;
  if (inertial.is_proportional()) {
    inertial.multiply_mass(a + inertial.zeta() * b, right);
  } else {
    inertial.multiply(a, b, right);
  }
  const Vector found = factor.solve(right) + inertial.share() * b;
  // Rounding times the condition of K̂, some 1e4.
  EXPECT_LE((found - expected).norm(), 1e-11 * expected.norm());
}

TEST(InertialLoad, NeedsNoStiffnessWhereDampingIsProportional) {
  expect_right_load(block({6, 2, 2}, 2e-4), true, true);
  expect_right_load(block({6, 2, 2}, 0), true, true);  // mass damping only
  test::BeamConstants beam;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  expect_right_load(test::straight_beam(beam), true, false);
}

TEST(InertialLoad, MultipliesByAnyOtherDamping) {
  fem::FeModel fe = block({6, 2, 2}, 2e-4);
  // As of two materials: the first rows are damped more.
  linalg::SparseMatrix more = fe.K_damping;
  for (int k = 0; k < 30; ++k) more.coeffRef(k, k) *= 3.0;
  fe.K_damping = more;
  expect_right_load(fe, false, true);
}

}  // namespace
}  // namespace buckens::stepping
