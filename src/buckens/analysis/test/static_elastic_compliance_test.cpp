// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>

#include "buckens/analysis/statics/elastic_compliance.h"
#include "buckens/analysis/test/static_models.h"
#include "buckens/base/errors.h"

namespace buckens::analysis::test {
namespace {

using linalg::Matrix;
using linalg::Vector;

// Rounding of a solve: 1e-16 times the condition of the grounded stiffness, about 1e7 here.
constexpr double kRounding = 1e-8;

std::unique_ptr<model::BuiltModel> beam(bool planar) {
  Mechanism m;
  if (planar) m.planar();
  m.beam("beam", 1.0, 5, {0.2, 0.1, 0}, 0.4);
  m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  m.force("beam/end", {0, 1, 0});
  return m.build();
}

TEST(ElasticCompliance, HoldsAsManyVariablesAsThereAreRigidMotions) {
  EXPECT_EQ(ElasticCompliance(beam(true)->model.bodies[0]).held().size(), 3u);
  EXPECT_EQ(ElasticCompliance(beam(false)->model.bodies[0]).held().size(), 6u);
}

TEST(ElasticCompliance, IsTheSievedInverseOfTheStiffness) {
  for (const bool planar : {true, false}) {
    SCOPED_TRACE(planar);
    const auto built = beam(planar);
    const body::FlexiblePart& part = *built->model.bodies[0].flexible;
    const ElasticCompliance compliance(built->model.bodies[0]);
    Vector f(part.num_dofs());
    for (Eigen::Index k = 0; k < f.size(); ++k) f[k] = std::sin(1.0 + 3.0 * static_cast<double>(k));
    const Vector d = compliance.solve(f);
    Vector sieved = f;
    part.sieve.apply_transposed(sieved);
    EXPECT_LE((part.fe.K * d - sieved).norm(), kRounding * sieved.norm());
    EXPECT_LE((part.sieve.P().transpose() * d).norm(), kRounding * d.norm());
    // Rigid loads, such as gravity, bend nothing.
    EXPECT_LE(compliance.solve(part.sieve.P().col(0)).norm(), 1e-12 * d.norm());
  }
}

TEST(ElasticCompliance, EqualsTheInverseOfTheStiffnessMadeDefinite) {
  // K + c P Pᵀ is definite and responds to sieved loads like K⁺, whatever c, FM (29).
  const auto built = beam(false);
  const body::FlexiblePart& part = *built->model.bodies[0].flexible;
  const ElasticCompliance compliance(built->model.bodies[0]);
  const Matrix P = part.sieve.P();
  const double c = part.fe.K.diagonal().maxCoeff() / (P * P.transpose()).diagonal().maxCoeff();
  const Matrix definite = Matrix(part.fe.K.whole()) + c * P * P.transpose();
  Matrix loads = Matrix(part.rows.topRows(part.num_interface_rows)).transpose();
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    Vector column = loads.col(k);
    part.sieve.apply_transposed(column);
    loads.col(k) = column;
  }
  const Matrix expected = definite.ldlt().solve(loads);
  EXPECT_LE((compliance.columns() - expected).norm(), kRounding * expected.norm());
  EXPECT_LE((compliance.interface() - compliance.interface().transpose()).norm(), 0.0);
}

TEST(ElasticCompliance, RefusesAMeshThatIsAMechanism) {
  // A square of four pin-jointed bars without a diagonal shears freely.
  Mechanism m;
  m.planar();
  body::BodySpec& spec = m.add("square", {0, 0, 0}, 0.0);
  fem::StructureSpec frame;
  const std::array<Vector3d, 4> corners = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0),
                                           Vector3d(0, 1, 0)};
  for (std::size_t k = 0; k < 4; ++k) {
    fem::NodeSpec node;
    node.name = "n" + std::to_string(k);
    node.position = corners[k];
    frame.nodes.push_back(node);
    fem::BarMemberSpec bar;
    bar.between = {"n" + std::to_string(k), "n" + std::to_string((k + 1) % 4)};
    bar.area = 1e-4;
    bar.material.value.E = kE;
    bar.material.value.rho = 7800;
    frame.bars.push_back(bar);
  }
  spec.kind = frame;
  m.joint<joints::SphericalSpec>("a", at_marker("ground"), at_marker("square/n0"));
  m.force("square/n2", {1, 0, 0});
  try {
    const auto built = m.build();
    const ElasticCompliance compliance(built->model.bodies[0]);
    FAIL() << "not refused";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("square"));
  }
}

}  // namespace
}  // namespace buckens::analysis::test
