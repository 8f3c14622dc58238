// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/element/elasticity.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Carbon fibres in epoxy resin along axis 1, turned.
Material ply() {
  Material material = Material::isotropic(1.0, 0.0, 1600.0);
  material.orthotropy =
      Orthotropy{{135e9, 10e9, 8e9}, 0.3, 0.25, 0.45, 5e9, 4e9, 3e9, test::some_rotation()};
  return material;
}

Eigen::Matrix<double, 6, 1> as_vector(const Matrix3d& stress) {
  Eigen::Matrix<double, 6, 1> out;
  out << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0);
  return out;
}

Matrix3d strain_matrix(const Eigen::Matrix<double, 6, 1>& e) {
  Matrix3d out;
  out << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2];
  return out;
}

// Tension and shear along the turned axes of the material reproduce its constants.
TEST(Orthotropy, ComplianceIsThatOfUniaxialTests) {
  const Orthotropy o = *ply().orthotropy;
  const Elasticity S = solid_elasticity(ply()).inverse();
  const auto strain = [&](int i, int j) -> Matrix3d {  // in the axes of the material
    Matrix3d stress = Matrix3d::Zero();
    stress(i, j) = stress(j, i) = 1.0;
    const Matrix3d in_model = o.axes * stress * o.axes.transpose();
    return o.axes.transpose() * strain_matrix(S * as_vector(in_model)) * o.axes;
  };
  const double scale = 1.0 / o.E.minCoeff();
  const auto expect = [&](double value, double expected) {
    EXPECT_NEAR(value, expected, 1e-13 * scale);
  };
  for (int i = 0; i < 3; ++i) expect(strain(i, i)(i, i), 1.0 / o.E[i]);
  expect(strain(0, 0)(1, 1), -o.nu12 / o.E[0]);
  expect(strain(0, 0)(2, 2), -o.nu13 / o.E[0]);
  expect(strain(1, 1)(2, 2), -o.nu23 / o.E[1]);
  expect(strain(1, 1)(0, 0), -o.nu12 / o.E[0]);
  expect(2 * strain(0, 1)(0, 1), 1.0 / o.G12);
  expect(2 * strain(0, 2)(0, 2), 1.0 / o.G13);
  expect(2 * strain(1, 2)(1, 2), 1.0 / o.G23);
  expect(strain(0, 1)(1, 2), 0.0);
  expect(strain(0, 0)(0, 1), 0.0);
}

TEST(Orthotropy, IsIsotropyWhereTheConstantsAre) {
  const Material steel = test::steel();
  Material same = steel;
  same.orthotropy = Orthotropy{
      Vector3d::Constant(steel.E), steel.nu, steel.nu, steel.nu, steel.G, steel.G, steel.G,
      test::some_rotation()};
  const Elasticity D = solid_elasticity(steel);
  EXPECT_LE((solid_elasticity(same) - D).norm(), 1e-14 * D.norm());
}

// The pull on a mesh: uniform stress along the fibres of a distorted block needs the nodal
// displacements that follow from the constants, in every kind of element.
TEST(Orthotropy, BlocksStretchAsTheirConstantsSay) {
  const Orthotropy o = *ply().orthotropy;
  const double pull = 1e6;
  Matrix3d strain = pull * Vector3d(1 / o.E[0], -o.nu12 / o.E[0], -o.nu13 / o.E[0]).asDiagonal();
  strain = (o.axes * strain * o.axes.transpose()).eval();
  const Matrix3d stress = pull * o.axes.col(0) * o.axes.col(0).transpose();
  for (const SolidForm& form : test::all_forms()) {
    SCOPED_TRACE(test::form_name(form));
    const FeModel fe = assemble(test::distorted_block(form, ply()));
    const linalg::Vector d = test::nodal_values(fe, [&](const Vector3d& x) { return strain * x; });
    const linalg::Matrix all = SolidRecovery(fe).stresses(d);
    for (Eigen::Index e = 0; e < all.cols(); ++e) {
      EXPECT_LE((all.col(e).head<6>() - as_vector(stress)).norm(), 1e-11 * pull);
    }
    const double energy = 0.5 * pull * pull / o.E[0] * fe.shape.mass / ply().rho;
    EXPECT_NEAR(0.5 * d.dot(fe.K * d), energy, 1e-11 * energy);
  }
}

TEST(Orthotropy, RefusesStrainsWithoutEnergy) {
  const auto refused = [](auto&& change, const char* words) {
    Material material = ply();
    change(*material.orthotropy);
    EXPECT_THAT([&] { check_solid_material("part", material); },
                ThrowsMessage<ModelError>(HasSubstr(words)));
    const Eigen::SelfAdjointEigenSolver<Elasticity> eigen{solid_elasticity(material)};
    EXPECT_FALSE(eigen.eigenvalues().minCoeff() > 1.0) << "was it refused with reason?";
  };
  check_solid_material("part", ply());
  refused([](Orthotropy& o) { o.E[1] = -1e9; }, "all must be positive");
  refused([](Orthotropy& o) { o.G13 = 0; }, "all must be positive");
  refused([](Orthotropy& o) { o.nu12 = 4; }, "|nu12| must be below sqrt(E1/E2) = 3.674");
  refused([](Orthotropy& o) { o.nu23 = 1.2; }, "|nu23| must be below sqrt(E2/E3)");
  refused([](Orthotropy& o) { o.nu12 = 2.5, o.nu13 = 2.5; }, "make one of them smaller");
}

TEST(Orthotropy, IsForSolidsOnly) {
  Structure s;
  add_node(s, "a", {0, 0, 0});
  add_node(s, "b", {1, 0, 0});
  Structure t = s;
  add_bar(s, 0, 1, 1, ply(), Section::circle(0.01));
  EXPECT_THAT([&] { assemble(s); }, ThrowsMessage<ModelError>(HasSubstr("orthotropic")));
  add_beam(t, 0, 1, 1,
           BeamProperties::of(ply(), Section::circle(0.01), BeamTheory::euler_bernoulli));
  EXPECT_THAT([&] { assemble(t); }, ThrowsMessage<ModelError>(HasSubstr("orthotropic")));
}

}  // namespace
}  // namespace buckens::fem
