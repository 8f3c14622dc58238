// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lowest_frequency.h"

#include <gtest/gtest.h>

#include "buckens/body/free_modes.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::stepping {
namespace {

TEST(LowestFrequency, OfBeamsIsThatOfTheFreeModes) {
  for (const int elements : {3, 40, 200}) {
    test::BeamConstants beam;
    beam.elements = elements;
    beam.alpha = 0.5;
    beam.beta = 1e-4;
    const model::Model model = test::spatial_beam_pendulum(beam);
    const body::FlexiblePart& part = *model.bodies[0].flexible;
    const body::FreeModes modes = body::free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), 1);
    for (const double h : {1e-4, 1e-3}) {
      BodyStepOperator op(part, Scheme(Method::generalized_alpha, h, 0.9));
      const long before = op.setup_solves();
      const double omega = lowest_frequency(part, op);
      // Never below; for reports one percent is enough.
      EXPECT_GE(omega, modes.omega[0] * (1.0 - 1e-6));
      EXPECT_LE(omega, modes.omega[0] * 1.01) << elements << " elements, h = " << h;
      EXPECT_LE(op.setup_solves() - before, 24);
    }
  }
}

TEST(LowestFrequency, OfSlenderSolidsNeedsFewSolves) {
  // 250 times as long as thick, in any direction. A step of a thousandth of the period hardly tells
  // slow shapes from each other: polynomials up to degree 3 alone are 12 % off after 100 solves.
  const Eigen::Quaterniond turn(Eigen::Vector4d(0.3, -0.5, 0.1, 0.8).normalized());
  for (const bool is_turned : {false, true}) {
    fem::Structure structure;
    fem::Box box;
    box.size = {25.0, 0.1, 0.1};
    box.divisions = {250, 1, 1};
    fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850));
    if (is_turned) {
      for (fem::Node& node : structure.nodes) node.position = turn * node.position;
    }
    const body::FlexiblePart part("block", fem::assemble(structure), body::CouplingLevel::full);
    const body::FreeModes modes = body::free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), 1);
    BodyStepOperator op(part, Scheme(Method::generalized_alpha, 1e-4, 0.9));
    const long before = op.setup_solves();
    const double omega = lowest_frequency(part, op);
    EXPECT_GE(omega, modes.omega[0] * (1.0 - 1e-6));
    EXPECT_LE(omega, modes.omega[0] * 1.01);
    EXPECT_LE(op.setup_solves() - before, 12);
    TaskPool pool(3);
    EXPECT_EQ(lowest_frequency(part, op, &pool), omega);
  }
}

}  // namespace
}  // namespace buckens::stepping
