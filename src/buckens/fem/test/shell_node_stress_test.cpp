// SPDX-License-Identifier: Apache-2.0
// Stresses of shells at nodes and of layers against closed forms.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/fem/shell/node_stress.h"
#include "buckens/fem/shell/recovery.h"
#include "buckens/fem/test/shell_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;
using test::ShellGrid;
using test::ShellKind;

constexpr double kE = 2e11, kNu = 0.25, kThickness = 0.01;

ShellSection plate(double thickness = kThickness) {
  return ShellSection::homogeneous(Material::isotropic(kE, kNu, 7800), thickness);
}

std::vector<int> all_nodes(const FeModel& fe) {
  std::vector<int> out(fe.nodes.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<int>(k);
  return out;
}

/// Nodal variables of a plane plate that is stretched by strain and bent to w = −½ xᵀ κ x, R its
/// axes: curvatures κ, rotations θ_x = w,y, θ_y = −w,x.
Vector stretched_and_bent(const FeModel& fe, const Matrix3d& R, const Vector3d& strain,
                          const Vector3d& bend) {
  Eigen::Matrix2d e, k;
  e << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  k << bend[0], bend[2] / 2, bend[2] / 2, bend[1];
  Vector d(fe.dofs.num_dofs);
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Vector3d local = R.transpose() * fe.nodes[n].position;
    const Eigen::Vector2d x = local.head<2>(), u = e * x, slope = -k * x;
    d.segment<3>(fe.dofs.node_dofs[n][0]) = R * Vector3d(u.x(), u.y(), -0.5 * x.dot(k * x));
    d.segment<3>(fe.dofs.node_dofs[n][3]) = R * Vector3d(slope.y(), -slope.x(), 0);
  }
  return d;
}

Matrix3d some_axes() {
  return Eigen::Quaterniond(0.7, 0.3, -0.5, 0.4).normalized().toRotationMatrix();
}

Matrix3d full_tensor(const Eigen::Matrix<double, 6, 1>& s) {
  Matrix3d out;
  out << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return out;
}

class ShellStresses : public testing::TestWithParam<ShellKind> {};

TEST_P(ShellStresses, OfAPlateStripAreSixMomentsOverThicknessSquared) {
  const ShellGrid grid(GetParam(), 4, 2, plate(),
                       [](double x, double y) { return Vector3d(x, 0.2 * y, 0); });
  const FeModel fe = assemble(grid.structure);
  const Vector3d strain(2e-5, -1e-5, 3e-5), bend(1e-2, 0, 0);
  const Vector d = stretched_and_bent(fe, Matrix3d::Identity(), strain, bend);
  const ShellRecovery recovery(fe);
  const Matrix strains = recovery.strains(d), forces = recovery.resultants(strains);
  const double D = kE * std::pow(kThickness, 3) / 12 / (1 - kNu * kNu), M = D * 1e-2;
  for (int e = 0; e < recovery.num_elements(); ++e) {
    // Rounding of stiff numbers: strains 1e-5 of displacements 1e-2.
    EXPECT_NEAR(forces(3, e), M, 1e-10 * M);
    EXPECT_NEAR(forces(4, e), kNu * M, 1e-10 * M);
    const double N = kE * kThickness / (1 - kNu * kNu) * (strain[0] + kNu * strain[1]);
    EXPECT_NEAR(forces(0, e), N, 1e-9 * N);
    EXPECT_NEAR(forces(2, e), kE / 2.5 * kThickness * strain[2], 1e-9 * N);
    const double membrane = N / kThickness, bending = 6 * M / (kThickness * kThickness);
    EXPECT_NEAR(recovery.stress(strains, e, {0, 1.0})[0], membrane + bending, 1e-9 * bending);
    EXPECT_NEAR(recovery.stress(strains, e, {0, 0.5})[0], membrane, 1e-9 * bending);
    EXPECT_NEAR(recovery.stress(strains, e, {0, 0.0})[0], membrane - bending, 1e-9 * bending);
  }
}

TEST_P(ShellStresses, OfLayersAreThoseOfTheirDirections) {
  Material fibre = Material::isotropic(1, 0, 1600);
  fibre.orthotropy =
      Orthotropy{{140e9, 10e9, 10e9}, 0.3, 0.3, 0.4, 5e9, 5e9, 3e9, Matrix3d::Identity()};
  const double angle = 0.5;
  ShellSection section{{{fibre, 0.002, angle}, {fibre, 0.003, -0.3}, {fibre, 0.001, 0.0}},
                       0.0,
                       Vector3d(some_axes() * Vector3d(std::cos(0.2), std::sin(0.2), 5)),
                       false};
  const Matrix3d R = some_axes();
  const ShellGrid grid(GetParam(), 2, 2, section, [&R](double x, double y) {
    return Vector3d(R * Vector3d(0.5 * x, 0.4 * y, 0));
  });
  const FeModel fe = assemble(grid.structure);
  const Vector3d strain(2e-5, -1e-5, 3e-5), bend(1e-2, 4e-3, -2e-3);
  const ShellRecovery recovery(fe);
  const Matrix strains = recovery.strains(stretched_and_bent(fe, R, strain, bend));
  for (int e = 0; e < recovery.num_elements(); ++e) {
    // x is the given direction projected, the normal that of the plane.
    const Matrix3d expected = R * Eigen::AngleAxisd(0.2, Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((recovery.axes(e) - expected).norm(), 1e-13);
    // Stress of the lowest layer by hand: strain along its fibres, Hooke's law, and back.
    const double z = -0.003;
    Eigen::Matrix2d whole;
    whole << strain[0] + z * bend[0], (strain[2] + z * bend[2]) / 2, (strain[2] + z * bend[2]) / 2,
        strain[1] + z * bend[1];
    const Eigen::Matrix2d to_fibre = Eigen::Rotation2Dd(0.2 + angle).toRotationMatrix();
    const Eigen::Matrix2d own = to_fibre.transpose() * whole * to_fibre;
    const double nu21 = 0.3 * 10 / 140, scale = 1 / (1 - 0.3 * nu21);
    Eigen::Matrix2d stress;
    stress << scale * (140e9 * own(0, 0) + nu21 * 140e9 * own(1, 1)), 10e9 * own(0, 1),
        10e9 * own(0, 1), scale * (10e9 * own(1, 1) + nu21 * 140e9 * own(0, 0));
    const Eigen::Matrix2d to_shell = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Eigen::Matrix2d in_shell = to_shell * stress * to_shell.transpose();
    const Vector3d found = recovery.stress(strains, e, {0, 0.0});
    const double size = stress.norm();
    EXPECT_NEAR(found[0], in_shell(0, 0), 1e-8 * size);
    EXPECT_NEAR(found[1], in_shell(1, 1), 1e-8 * size);
    EXPECT_NEAR(found[2], in_shell(0, 1), 1e-8 * size);
  }
}

TEST_P(ShellStresses, AtNodesAreExactInConstantStates) {
  const Matrix3d R = some_axes();
  const ShellGrid grid(
      GetParam(), 3, 3, plate(),
      [&R](double x, double y) {
        const double bump = x * (1 - x) * y * (1 - y);
        return Vector3d(R * Vector3d(x + bump, 0.7 * y - 0.8 * bump, 0));
      },
      test::Sides::straight);
  const FeModel fe = assemble(grid.structure);
  const Vector3d strain(2e-5, -1e-5, 3e-5), bend(1e-2, -4e-3, 6e-3);
  const Vector d = stretched_and_bent(fe, R, strain, bend);
  const ShellNodeStresses nodes(fe, all_nodes(fe));
  ASSERT_EQ(nodes.places().size(), fe.nodes.size());
  const Vector values = nodes.rows() * d;
  const auto surface = nodes.surface(values.reshaped(6, values.size() / 6));
  const auto stress_at = [&](double z) {
    const Vector3d e = strain + z * bend;
    const double C = kE / (1 - kNu * kNu);
    Matrix3d s = Matrix3d::Zero();
    s(0, 0) = C * (e[0] + kNu * e[1]);
    s(1, 1) = C * (e[1] + kNu * e[0]);
    s(0, 1) = s(1, 0) = kE / (2 * (1 + kNu)) * e[2];
    return s;
  };
  const auto mises = [](const Matrix3d& s) {
    return std::sqrt(s(0, 0) * s(0, 0) + s(1, 1) * s(1, 1) - s(0, 0) * s(1, 1) +
                     3 * s(0, 1) * s(0, 1));
  };
  const Matrix3d top = stress_at(kThickness / 2), bottom = stress_at(-kThickness / 2);
  for (Eigen::Index p = 0; p < surface.stress.cols(); ++p) {
    EXPECT_LT((full_tensor(surface.stress.col(p)) - R * top * R.transpose()).norm(),
              1e-8 * top.norm());
    EXPECT_NEAR(surface.mises[p], std::max(mises(top), mises(bottom)), 1e-8 * top.norm());
    // σ_z = 0: the strain across is −ν/E (σ_x + σ_y).
    Eigen::Matrix<double, 6, 1> e = surface.strain.col(p);
    e.tail<3>() /= 2;
    const Vector3d n = R.col(2);
    EXPECT_NEAR(n.dot(full_tensor(e) * n), -kNu / kE * (top(0, 0) + top(1, 1)), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShellStresses,
                         testing::Values(ShellKind::quad4, ShellKind::tri3, ShellKind::quad8,
                                         ShellKind::tri6),
                         [](const auto& kind) { return test::shell_name(kind.param); });

/// Two squares side by side along x with a common side x = 1; the second one is turned about it.
struct TwoPlates {
  Structure s;
  TwoPlates(double angle, const ShellSection& second, bool is_turned_over, bool has_rib) {
    const double c = std::cos(angle), w = std::sin(angle);
    for (const Vector3d& x : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0),
                              Vector3d(0, 1, 0), Vector3d(1 + c, 0, w), Vector3d(1 + c, 1, w)}) {
      s.nodes.push_back({"", x});
    }
    s.shells.add(std::vector{0, 1, 2, 3}, s.shells.add_section(plate()));
    const int number = s.shells.add_section(second);
    s.shells.add(is_turned_over ? std::vector{1, 2, 5, 4} : std::vector{1, 4, 5, 2}, number);
    if (!has_rib) return;
    s.nodes.push_back({"", {1, 0, -1}});
    s.nodes.push_back({"", {1, 1, -1}});
    s.shells.add(std::vector{1, 2, 7, 6}, s.shells.add_section(plate()));
  }
  /// Places of a node on the common side.
  std::size_t places() const {
    const FeModel fe = assemble(s);
    return ShellNodeStresses(fe, {1}).places().size();
  }
};

TEST(ShellPlaces, AreCommonToNeighboursOnly) {
  const double smooth = 0.3, sharp = 0.6;
  EXPECT_EQ(TwoPlates(0, plate(), false, false).places(), 1u);
  EXPECT_EQ(TwoPlates(smooth, plate(), false, false).places(), 1u);
  EXPECT_EQ(TwoPlates(sharp, plate(), false, false).places(), 2u) << "an edge";
  EXPECT_EQ(TwoPlates(0, plate(0.02), false, false).places(), 2u) << "another thickness";
  EXPECT_EQ(TwoPlates(0, plate(), true, false).places(), 2u) << "turned over";
  EXPECT_EQ(TwoPlates(0, plate(), false, true).places(), 3u) << "a rib below";
  Material soft = Material::isotropic(kE / 2, kNu, 7800);
  EXPECT_EQ(TwoPlates(0, ShellSection::homogeneous(soft, kThickness), false, false).places(), 2u)
      << "another material";
}

TEST(ShellPlaces, BelongToTheirElements) {
  const TwoPlates plates(0, plate(0.02), false, false);
  const FeModel fe = assemble(plates.s);
  const ShellNodeStresses nodes(fe, {2, 0});
  EXPECT_EQ(nodes.places().size(), 3u);
  EXPECT_NE(nodes.place_of(2, 0), nodes.place_of(2, 1));
  EXPECT_EQ(nodes.places()[static_cast<std::size_t>(nodes.place_of(0, 0))].node, 0);
  EXPECT_EQ(nodes.place_of(0, 1), -1) << "not a node of it";
  EXPECT_EQ(nodes.place_of(1, 0), -1) << "not wanted";
}

TEST(ShellPlaces, HaveTheStressOfABentStripToSecondOrder) {
  // w = sin(πx) bends cylindrically; at nodes inside the mean of both elements is right to h².
  const auto error = [](int n) {
    const ShellGrid grid(ShellKind::quad4, n, 1, plate(),
                         [](double x, double y) { return Vector3d(x, 0.1 * y, 0); });
    const FeModel fe = assemble(grid.structure);
    Vector d = Vector::Zero(fe.dofs.num_dofs);
    for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
      const double x = fe.nodes[k].position.x() * std::numbers::pi;
      d[fe.dofs.node_dofs[k][2]] = std::sin(x);
      d[fe.dofs.node_dofs[k][4]] = -std::numbers::pi * std::cos(x);
    }
    const ShellNodeStresses nodes(fe, {grid.node(n / 2, 0)});
    const Vector values = nodes.rows() * d;
    const double pi2 = std::numbers::pi * std::numbers::pi;
    return std::abs(values[3] - pi2) / pi2;  // κ_x = −w,xx
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2.0, 0.05);
}

}  // namespace
}  // namespace buckens::fem
