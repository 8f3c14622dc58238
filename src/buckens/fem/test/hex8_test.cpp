// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assemble.h"
#include "buckens/fem/box_mesh.h"
#include "buckens/fem/hex8_shape.h"
#include "buckens/fem/solid_recovery.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A 2×2×2 block whose nodes are moved about, so that no element is a parallelepiped.
Structure distorted_block() {
  Structure s;
  add_box(s, {{0.1, -0.2, 0.3}, {0.4, 0.3, 0.2}, {2, 2, 2}}, test::steel());
  for (std::size_t k = 0; k < s.nodes.size(); ++k) {
    const double t = static_cast<double>(k);
    s.nodes[k].position += 0.02 * Vector3d(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t + 1));
  }
  return s;
}

struct GaussRule {
  std::array<double, 5> place, weight;
};

/// Five points, twice what the integrands need and none of those of the element.
GaussRule five_points() {
  const double a = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double b = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double wa = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0;
  const double wb = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  return {{-b, -a, 0.0, a, b}, {wb, wa, 128.0 / 225.0, wa, wb}};
}

TEST(Hex8, InertiaIntegralsMatchQuadrature) {
  const Structure s = distorted_block();
  const FeModel fe = assemble(s);
  const auto n = static_cast<Eigen::Index>(fe.nodes.size());
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  Matrix Ms = Matrix::Zero(n, n);
  Matrix3d second = Matrix3d::Zero();
  Matrix c = Matrix::Zero(fe.dofs.num_dofs, 9);
  const GaussRule rule = five_points();
  for (int e = 0; e < s.solids.num_elements(); ++e) {
    Hex8Corners x;
    const auto nodes = s.solids.nodes(e);
    for (int i = 0; i < 8; ++i) {
      x.col(i) = s.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])].position;
    }
    for (std::size_t point = 0; point < 125; ++point) {
      const std::array<std::size_t, 3> at = {point / 25, point / 5 % 5, point % 5};
      const Hex8Point p = hex8_point(x, {rule.place[at[0]], rule.place[at[1]], rule.place[at[2]]});
      const double dm = test::steel().rho * p.volume * rule.weight[at[0]] * rule.weight[at[1]] *
                        rule.weight[at[2]];
      const Vector3d place = x * p.N;
      const Vector3d s0 = place - fe.shape.com;
      mass += dm;
      first += dm * place;
      second += dm * s0 * s0.transpose();
      for (int i = 0; i < 8; ++i) {
        const int I = nodes[static_cast<std::size_t>(i)];
        for (int j = 0; j < 8; ++j)
          Ms(I, nodes[static_cast<std::size_t>(j)]) += dm * p.N[i] * p.N[j];
        for (int a = 0; a < 3; ++a) {
          for (int b = 0; b < 3; ++b) c(3 * I + b, 3 * a + b) += dm * s0[a] * p.N[i];
        }
      }
    }
  }
  // All integrands are polynomials that both rules integrate exactly: rounding of 1000 terms.
  EXPECT_NEAR(fe.shape.mass, mass, 1e-13 * mass);
  EXPECT_LE((fe.shape.com - first / mass).norm(), 1e-14);
  EXPECT_LE((Matrix(fe.shape.nodal.Ms) - Ms).norm(), 1e-13 * Ms.norm());
  EXPECT_LE((fe.shape.C0 - second).norm(), 1e-13 * second.norm());
  EXPECT_LE((fe.shape.c - c).norm(), 1e-13 * c.norm());
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(fe.shape.W[k].nonZeros(), 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index a = 0; a < 3; ++a) {
      for (Eigen::Index b = 0; b < 3; ++b) {
        EXPECT_NEAR(fe.M.coeff(3 * i + a, 3 * (n - 1 - i) + b), a == b ? Ms(i, n - 1 - i) : 0.0,
                    1e-13 * Ms.norm());
      }
    }
  }
}

TEST(Hex8, OnlyRigidMotionIsFree) {
  for (const bool distorted : {false, true}) {
    Structure s = distorted_block();
    if (!distorted) {
      s = {};
      add_box(s, {{0, 0, 0}, {0.3, 0.2, 0.1}, {1, 1, 1}}, test::steel());
    }
    const FeModel fe = assemble(s);
    const Matrix Q = test::rigid_motions(fe);
    EXPECT_LE((fe.K * Q).norm(), 1e-14 * fe.K.norm() * Q.norm());
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen{Matrix(fe.K)};
    const Vector values = eigen.eigenvalues() / eigen.eigenvalues().maxCoeff();
    EXPECT_LE(values.head<6>().cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_GE(values[6], 1e-4);  // shear of the thin direction; hourglass modes would be at 1e-16
    // S = QᵀMQ: the generalised rigid masses are those of the integrals.
    const Matrix S = Q.transpose() * (fe.M * Q);
    const Matrix3d turning = S.bottomRightCorner<3, 3>();
    EXPECT_LE((turning - fe.shape.J0).norm(), 1e-13 * fe.shape.J0.norm());
    const Matrix3d mixed = S.topRightCorner<3, 3>();
    EXPECT_LE(mixed.norm(), 1e-13 * fe.shape.mass * 0.3);
  }
}

TEST(Hex8, PatchTest) {
  const FeModel fe = assemble(distorted_block());
  Matrix3d slope;
  slope << 1e-3, 2e-4, -3e-4, 5e-4, -4e-4, 1e-4, 2e-4, 6e-4, 7e-4;
  Vector d(fe.dofs.num_dofs);
  for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
    d.segment<3>(3 * static_cast<Eigen::Index>(k)) = slope * fe.nodes[k].position;
  }
  // The only node inside the block carries no force; all elements have Hooke's stress.
  const Vector force = fe.K * d;
  EXPECT_LE(force.segment<3>(3 * 13).norm(), 1e-12 * force.norm());
  const Matrix3d strain = 0.5 * (slope + slope.transpose());
  const Material steel = test::steel();
  const Matrix3d stress = 2.0 * steel.G * strain + steel.E * steel.nu /
                                                       ((1 + steel.nu) * (1 - 2 * steel.nu)) *
                                                       strain.trace() * Matrix3d::Identity();
  Eigen::Matrix<double, 7, 1> expected;
  const Matrix3d deviator = stress - stress.trace() / 3.0 * Matrix3d::Identity();
  expected << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0),
      std::sqrt(1.5) * deviator.norm();
  const Matrix all = SolidRecovery(fe).stresses(d);
  ASSERT_EQ(all.cols(), 8);
  for (Eigen::Index e = 0; e < 8; ++e) {
    EXPECT_LE((all.col(e) - expected).norm(), 1e-12 * expected.norm()) << "element " << e;
  }
}

TEST(Hex8, RefusesElementsInsideOut) {
  Structure s = distorted_block();
  std::swap(s.nodes[0].position, s.nodes[1].position);
  EXPECT_THAT([&] { assemble(s); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("solid element 1"), HasSubstr("Jacobian"),
                                              HasSubstr("counter-clockwise"))));
  Structure flat;
  add_box(flat, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, test::steel());
  for (Node& node : flat.nodes) node.position.z() = 0;
  EXPECT_THAT([&] { assemble(flat); }, ThrowsMessage<ModelError>(HasSubstr("squashed flat")));
}

TEST(Hex8, RefusesMaterialsThatNoSolidHas) {
  Structure s;
  Material rubber = Material::isotropic(1e6, 0.5, 1000);
  add_box(s, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber);
  EXPECT_THAT([&] { assemble(s); }, ThrowsMessage<ModelError>(HasSubstr("nu = 0.5")));
  Structure t;
  rubber = Material::isotropic(1e6, 0.3, 1000);
  rubber.G = 1e6;
  add_box(t, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber);
  EXPECT_THAT([&] { assemble(t); }, ThrowsMessage<ModelError>(HasSubstr("leave `G` out")));
}

TEST(Hex8, KeepsAllTranslationsInPlanarModels) {
  const FeModel fe = assemble(distorted_block(), spatial::Plane::xy);
  EXPECT_EQ(fe.dofs.num_dofs, 81);
}

TEST(Hex8, MixesWithOtherElements) {
  Structure s;
  const int first = add_box(s, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, test::steel());
  const int tip = add_node(s, "tip", {0, 0, 2});
  for (const int corner : {4, 5, 6})
    s.bars.add(first + corner, tip, test::steel(), Section::circle(0.01));
  s.masses.add(tip, 3.0);
  const FeModel fe = assemble(s);
  const Matrix Q = test::rigid_motions(fe);
  const Matrix S = Q.transpose() * (fe.M * Q);
  EXPECT_NEAR(S(0, 0), fe.shape.mass, 1e-13 * fe.shape.mass);
  const Matrix3d turning = S.bottomRightCorner<3, 3>();
  EXPECT_LE((turning - fe.shape.J0).norm(), 1e-13 * fe.shape.J0.norm());
}

TEST(BoxMesh, NamesItsNodes) {
  const Box box{{0, 0, 0}, {1, 1, 1}, {4, 2, 1}};
  Structure s;
  add_box(s, box, test::steel());
  EXPECT_EQ(s.nodes.size(), 30u);
  EXPECT_EQ(s.solids.num_elements(), 8);
  const auto places = named_places(box);
  const auto node = [&](const std::string& name) {
    for (const auto& place : places) {
      if (place.name == name) return box.node(place.place);
    }
    return -1;
  };
  EXPECT_EQ(node("node_first"), 0);
  EXPECT_EQ(node("node_last"), 29);
  EXPECT_EQ(node("corner_100"), 4);
  EXPECT_EQ(node("corner_010"), 10);
  EXPECT_EQ(node("corner_001"), 15);
  EXPECT_EQ(node("face_z0"), 7);  // (2, 1, 0)
  EXPECT_EQ(node("face_x0"), -1) << "one element across z: no node at the centre of that face";
  EXPECT_THROW(add_box(s, {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}, test::steel()), ModelError);
}

TEST(SolidRecovery, FindsTheSurface) {
  Structure s;
  add_box(s, {{0, 0, 0}, {3, 2, 1}, {3, 2, 1}}, test::steel());
  const FeModel fe = assemble(s);
  const auto faces = surface_faces(fe);
  EXPECT_EQ(faces.size(), 2u * (3 * 2 + 2 * 1 + 3 * 1));
  Vector3d area = Vector3d::Zero();
  double volume = 0;  // by the divergence theorem: normals point outwards
  for (const SurfaceFace& face : faces) {
    const auto at = [&](std::size_t k) {
      return fe.nodes[static_cast<std::size_t>(face.nodes[k])].position;
    };
    const Vector3d normal = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
    area += normal;
    volume += normal.dot(0.25 * (at(0) + at(1) + at(2) + at(3))) / 3.0;
  }
  EXPECT_LE(area.norm(), 1e-14);
  EXPECT_NEAR(volume, 6.0, 1e-13);
  EXPECT_EQ(solids_at_nodes(fe)[5].size(), 4u);  // (1, 1, 0)
}

}  // namespace
}  // namespace buckens::fem
