// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_motion.h"

#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/inverse_iteration.h"

namespace buckens::body {
namespace {

using linalg::Vector;

std::unique_ptr<FlexiblePart> block(fem::SolidKind kind, double rho = 7850) {
  fem::Structure s;
  fem::Box box;
  box.from = {0.1, -0.2, 0.05};
  box.size = {0.5, 0.2, 0.1};
  box.divisions = {4, 3, 2};
  fem::add_box(s, box, fem::Material::isotropic(2.1e11, 0.3, rho), fem::SolidForm::usual(kind));
  return std::make_unique<FlexiblePart>("block", fem::assemble(s), CouplingLevel::full);
}

TEST(NodalMotion, EqualsTheMatricesOfSieveAndPatterns) {
  for (const fem::SolidKind kind : {fem::SolidKind::hex8, fem::SolidKind::tet10}) {
    const auto part = block(kind);
    const auto motion = NodalMotion::of(*part);
    ASSERT_NE(motion, nullptr);
    const Eigen::Index n = part->num_dofs();
    const Vector x = linalg::scattered_block(n, 1, 3);
    linalg::NodeSums sums;
    // In two pieces.
    motion->add_moments(0, 9, x, sums);
    motion->add_moments(9, n - 9, x, sums);
    // Sums of some hundred numbers in another order.
    const Vector rigid = part->sieve.P().transpose() * x;
    EXPECT_LE((motion->rigid(sums) - rigid).norm(), 1e-13 * part->sieve.P().norm() * x.norm());
    const linalg::Matrix& c = part->invariants.centrifugal_patterns();
    EXPECT_LE((NodalMotion::patterns(sums) - c.transpose() * x).norm(),
              1e-13 * c.norm() * x.norm());
    const NodalMotion::Vector6 amplitudes = NodalMotion::Vector6::LinSpaced(-1.0, 2.0);
    Vector y = x, Mx(n);
    motion->subtract(0, 30, motion->motion(amplitudes), y);
    motion->subtract(30, n - 30, motion->motion(amplitudes), y);
    const Vector expected = x - part->sieve.Phi() * amplitudes;
    EXPECT_LE((y - expected).norm(), 1e-13 * expected.norm());
    motion->multiply_mass(0, n, x, Mx);
    EXPECT_LE((Mx - part->fe.M * x).norm(), 1e-13 * Mx.norm());
  }
}

TEST(NodalMotion, TellsBodiesApart) {
  const auto steel = NodalMotion::of(*block(fem::SolidKind::hex8));
  const auto same = NodalMotion::of(*block(fem::SolidKind::hex8));
  const auto lighter = NodalMotion::of(*block(fem::SolidKind::hex8, 2700));
  EXPECT_TRUE(*steel == *same);
  EXPECT_FALSE(*steel == *lighter);
}

TEST(NodalMotion, IsForSolidsOnly) {
  fem::Structure s;
  fem::add_node(s, "start", {0, 0, 0});
  fem::add_node(s, "end", {1, 0, 0});
  fem::add_beam(s, 0, 1, 4,
                fem::BeamProperties::of(fem::Material::isotropic(2.1e11, 0.3, 7850.0),
                                        fem::Section::rectangle(0.02, 0.01),
                                        fem::BeamTheory::euler_bernoulli));
  const FlexiblePart part("rod", fem::assemble(s), CouplingLevel::full);
  EXPECT_EQ(NodalMotion::of(part), nullptr);
}

}  // namespace
}  // namespace buckens::body
