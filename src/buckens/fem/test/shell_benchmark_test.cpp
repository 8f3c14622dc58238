// SPDX-License-Identifier: Apache-2.0
// Shells against the reference problems of MacNeal and Harder (1985) and NAFEMS FV12.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/fem/test/held_solution.h"
#include "buckens/fem/test/shell_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;
using linalg::Vector;
using test::Held;
using test::ShellGrid;
using test::ShellKind;

constexpr double kPi = std::numbers::pi;

double value(const FeModel& fe, const Vector& d, int node, std::size_t variable) {
  return d[fe.dofs.node_dofs[static_cast<std::size_t>(node)][variable]];
}

Vector point_force(const FeModel& fe, int node, const Vector3d& force) {
  Vector f = Vector::Zero(fe.dofs.num_dofs);
  f.segment<3>(fe.dofs.node_dofs[static_cast<std::size_t>(node)][0]) = force;
  return f;
}

Vector solve(const FeModel& fe, const Vector& f, const Held& held) {
  return test::solve(fe, f, held.given, Vector::Zero(fe.dofs.num_dofs));
}

/// Vertical displacement at the middle of the free edge over 0.3024.
double scordelis_lo(ShellKind kind, int n) {
  const Material m = Material::isotropic(4.32e8, 0.0, 1.0);
  ShellGrid grid(kind, n, n, ShellSection::homogeneous(m, 0.25), [](double x, double y) {
    const double phi = y * 40 * kPi / 180;
    return Vector3d(25 * x, 25 * std::sin(phi), 25 * std::cos(phi));
  });
  const FeModel fe = assemble(grid.structure);
  Held held(fe);
  for (int k = 0; k <= n; ++k) {
    held.hold(grid.node(0, k), {1, 2});     // diaphragm
    held.hold(grid.node(n, k), {0, 4, 5});  // symmetry in the middle of the length
    held.hold(grid.node(k, 0), {1, 3, 5});  // symmetry at the crown
  }
  const Vector d = solve(fe, test::area_load(fe, grid.structure.shells, {0, 0, -90}), held);
  return -value(fe, d, grid.node(n, n), 2) / 0.3024;
}

/// Displacement under the load over 1.8248e-5.
double pinched_cylinder(ShellKind kind, int n) {
  const Material m = Material::isotropic(3e6, 0.3, 1.0);
  ShellGrid grid(kind, n, n, ShellSection::homogeneous(m, 3.0), [](double x, double y) {
    return Vector3d(300 * x, 300 * std::sin(y * kPi / 2), 300 * std::cos(y * kPi / 2));
  });
  const FeModel fe = assemble(grid.structure);
  Held held(fe);
  for (int k = 0; k <= n; ++k) {
    held.hold(grid.node(0, k), {0, 4, 5});  // symmetry in the middle of the length
    held.hold(grid.node(n, k), {1, 2});     // diaphragm
    held.hold(grid.node(k, 0), {1, 3, 5});
    held.hold(grid.node(k, n), {2, 3, 4});
  }
  const Vector d = solve(fe, point_force(fe, grid.node(0, 0), {0, 0, -0.25}), held);
  return -value(fe, d, grid.node(0, 0), 2) / 1.8248e-5;
}

/// Displacement under one of the loads over 0.0940.
double hemisphere(ShellKind kind, int n) {
  const Material m = Material::isotropic(6.825e7, 0.3, 1.0);
  ShellGrid grid(kind, n, n, ShellSection::homogeneous(m, 0.04), [](double x, double y) {
    const double azimuth = x * kPi / 2, height = y * 72 * kPi / 180;
    return Vector3d(10 * std::cos(height) * std::cos(azimuth),
                    10 * std::cos(height) * std::sin(azimuth), 10 * std::sin(height));
  });
  const FeModel fe = assemble(grid.structure);
  Held held(fe);
  for (int k = 0; k <= n; ++k) {
    held.hold(grid.node(0, k), {1, 3, 5});
    held.hold(grid.node(n, k), {0, 4, 5});
  }
  held.hold(grid.node(n / 2, 0), {2});
  const Vector f =
      point_force(fe, grid.node(0, 0), {1, 0, 0}) + point_force(fe, grid.node(n, 0), {0, -1, 0});
  return value(fe, solve(fe, f, held), grid.node(0, 0), 0) / 0.0940;
}

/// Tip displacements in and out of the plane of the tip over 5.424e-3 and 1.754e-3.
std::pair<double, double> twisted_beam(ShellKind kind, int along, int across) {
  const Material m = Material::isotropic(29e6, 0.22, 1.0);
  ShellGrid grid(kind, along, across, ShellSection::homogeneous(m, 0.32), [](double x, double y) {
    const double turn = x * kPi / 2, at = 1.1 * (y - 0.5);
    return Vector3d(12 * x, at * std::cos(turn), at * std::sin(turn));
  });
  const FeModel fe = assemble(grid.structure);
  Held held(fe);
  for (int k = 0; k <= across; ++k) held.hold(grid.node(0, k), {0, 1, 2, 3, 4, 5});
  const int tip = grid.node(along, across / 2);
  const Vector in_plane = solve(fe, point_force(fe, tip, {0, 0, 1}), held);
  const Vector out_of_plane = solve(fe, point_force(fe, tip, {0, 1, 0}), held);
  return {value(fe, in_plane, tip, 2) / 5.424e-3, value(fe, out_of_plane, tip, 1) / 1.754e-3};
}

/// Frequencies of NAFEMS FV12 [Hz].
Eigen::VectorXd free_plate(ShellKind kind, int n) {
  const Material m = Material::isotropic(200e9, 0.3, 8000);
  ShellGrid grid(kind, n, n, ShellSection::homogeneous(m, 0.05),
                 [](double x, double y) { return Vector3d(10 * x, 10 * y, 0); });
  const FeModel fe = assemble(grid.structure);
  // The bending of a flat plate alone: u_z, θ_x, θ_y.
  std::vector<Eigen::Index> kept;
  for (const auto& dofs : fe.dofs.node_dofs) kept.insert(kept.end(), {dofs[2], dofs[3], dofs[4]});
  const Eigen::MatrixXd K = Eigen::MatrixXd(fe.K)(kept, kept);
  const Eigen::MatrixXd M = Eigen::MatrixXd(fe.M)(kept, kept);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, M,
                                                                        Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().segment(3, 8).cwiseSqrt() / (2 * kPi);
}

class ShellProblems : public testing::TestWithParam<ShellKind> {
 protected:
  bool is_quad() const { return GetParam() == ShellKind::quad4; }
};

// The lines are read by docs/figures/shell_benchmarks.py.
TEST_P(ShellProblems, ConvergeToTheReferences) {
  const std::string kind = test::shell_name(GetParam());
  for (const int n : {4, 8, 16}) {
    const double roof = scordelis_lo(GetParam(), n), cylinder = pinched_cylinder(GetParam(), n);
    const double sphere = hemisphere(GetParam(), n);
    const auto [in_plane, across] = twisted_beam(GetParam(), 3 * n, n / 2);
    fmt::print(
        "shell {} n={} Scordelis-Lo={:.4f} cylinder={:.4f} hemisphere={:.4f} twist-in={:.4f} "
        "twist-across={:.4f}\n",
        kind, n, roof, cylinder, sphere, in_plane, across);
    if (n < 16) continue;
    // Measured 0.9977, 0.9318, 0.9885, 0.9983, 0.9991 (quad4) and 0.9977, 0.8962, 0.9231, 0.9982,
    // 1.0000 (tri3): the point load needs a fine mesh, the triangle locks on the thin hemisphere.
    EXPECT_NEAR(roof, 1.0, 0.005);
    EXPECT_NEAR(cylinder, is_quad() ? 0.932 : 0.896, 0.005);
    EXPECT_NEAR(sphere, is_quad() ? 0.9885 : 0.923, 0.005);
    EXPECT_NEAR(in_plane, 1.0, 0.005);
    EXPECT_NEAR(across, 1.0, 0.005);
  }
}

TEST_P(ShellProblems, HaveTheFrequenciesOfAFreePlate) {
  const Eigen::VectorXd nafems =
      (Eigen::VectorXd(8) << 1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668).finished();
  for (const int n : {4, 8}) {
    const Eigen::VectorXd ratio = free_plate(GetParam(), n).cwiseQuotient(nafems);
    fmt::print("shell {} n={}", test::shell_name(GetParam()), n);
    for (Eigen::Index k = 0; k < 8; ++k) fmt::print(" FV12-{}={:.4f}", k + 1, ratio[k]);
    fmt::print("\n");
    if (n < 8) continue;
    // Measured up to 1.092 (quad4) and 1.077 (tri3), always above, falling with h²: with 16
    // elements 1.023 and 1.020 (tests/test_shells.py).
    for (Eigen::Index k = 0; k < 8; ++k) {
      EXPECT_GE(ratio[k], 1.0) << k;
      EXPECT_LE(ratio[k], is_quad() ? 1.094 : 1.079) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShellProblems, testing::Values(ShellKind::quad4, ShellKind::tri3),
                         [](const auto& kind) { return test::shell_name(kind.param); });

}  // namespace
}  // namespace buckens::fem
