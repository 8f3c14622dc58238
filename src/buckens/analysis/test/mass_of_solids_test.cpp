// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

/// A soft block on a ball joint, damped by mass and stiffness.
model::test::Described swinging_block(body::CouplingLevel level) {
  model::test::Described m;
  m.d.gravity = {0, -9.81, 0};
  body::BodySpec& block = m.block("block", {0.3, 0.1, 0.1}, {6, 2, 2});
  block.coupling.level = level;
  fem::DampingSpec damping;
  damping.mass = 0.2;
  damping.stiffness = 1e-6;
  block.damping = damping;
  m.joint<joints::SphericalSpec>("pin", "ground", "block/corner_000");
  m.d.simulation.emplace();
  m.d.simulation->duration = 0.02;
  m.d.simulation->step = 1e-3;
  return m;
}

/// Of the mesh behind the first body.
const linalg::SymmetricMatrix& mass_of_mesh(const model::Model& model) {
  return model.bodies[0].flexible->mesh().M;
}

TEST(MassOfSolids, RunsNeedNoneOfItsEntries) {
  for (const auto level : {body::CouplingLevel::full, body::CouplingLevel::none}) {
    const auto built = swinging_block(level).build();
    results::Table table;
    EXPECT_TRUE(simulate(*built, table).finished);
    const linalg::SymmetricMatrix& M = built->model.bodies[0].flexible->fe.M;
    EXPECT_NE(M.nodes(), nullptr);
    EXPECT_EQ(M.nodes(), built->model.bodies[0].flexible->fe.shape.nodal.Ms.get());
    EXPECT_FALSE(M.is_formed());
  }
}

TEST(MassOfSolids, MeshesOfReducedBodiesKeepNoneOfItsEntries) {
  auto m = swinging_block(body::CouplingLevel::full);
  m.d.bodies[0].reduction.craig_bampton.emplace();
  m.d.bodies[0].reduction.craig_bampton->modes = 3;
  const auto built = m.build();
  EXPECT_NE(mass_of_mesh(built->model).nodes(), nullptr);
  EXPECT_FALSE(mass_of_mesh(built->model).is_formed());
}

TEST(MassOfSolids, MeshesBehindRigidInterfacesKeepNoneOfItsEntries) {
  auto m = swinging_block(body::CouplingLevel::full);
  body::InterfaceSpec face;
  face.name = "face";
  face.where = model::test::at_line(45);
  face.region = fem::NamedFaceSpec{model::test::at_line(46), "x1"};
  face.kind = body::InterfaceKind::rigid;
  m.d.bodies[0].interfaces = {face};
  const auto built = m.build();
  EXPECT_EQ(built->model.bodies[0].flexible->fe.M.nodes(), nullptr);
  EXPECT_NE(mass_of_mesh(built->model).nodes(), nullptr);
  EXPECT_FALSE(mass_of_mesh(built->model).is_formed());
}

}  // namespace
}  // namespace buckens::analysis
