// SPDX-License-Identifier: Apache-2.0
// Solids against exact solutions: orders of convergence, bending of slender bars.
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/solid/element.h"
#include "buckens/fem/test/held_solution.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;
using test::solve;

std::vector<bool> held(const Structure& s, const std::vector<std::string>& faces) {
  std::vector<bool> out(3 * s.nodes.size(), false);
  for (const std::string& name : faces) {
    for (const int node : face_set_nodes(s.solids, find_face_set(s, name)->faces)) {
      for (int a = 0; a < 3; ++a) out[static_cast<std::size_t>(3 * node + a)] = true;
    }
  }
  return out;
}

/// A displacement field with its body force in the unit cube, E = 1, ν = 0.3: every component is
/// c_a sin(k_a·x + p_a).
struct ManufacturedField {
  Matrix3d k;  // column a: wave vector of component a
  Vector3d amplitude{1.0, -0.7, 0.4}, phase{0.3, 1.1, -0.4};

  ManufacturedField() { k << 1.3, 0.8, -0.9, 0.7, 1.5, 1.1, -1.0, 0.6, 1.4; }

  Vector3d angle(const Vector3d& x) const { return k.transpose() * x + phase; }
  Vector3d at(const Vector3d& x) const {
    return amplitude.cwiseProduct(angle(x).array().sin().matrix());
  }
  Matrix3d slope(const Vector3d& x) const {  // ∂u_a/∂x_b
    return amplitude.cwiseProduct(angle(x).array().cos().matrix()).asDiagonal() * k.transpose();
  }
  /// −div σ = −(λ + μ) grad div u − μ Δu.
  Vector3d force(const Vector3d& x) const {
    const double lame = 0.3 / (1.3 * 0.4), shear = 1.0 / 2.6;
    const Vector3d u = at(x);
    Vector3d out;
    for (int b = 0; b < 3; ++b) {
      double gradient = 0;  // ∂/∂x_b of div u
      for (int a = 0; a < 3; ++a) gradient -= k(a, a) * k(b, a) * u[a];
      out[b] = -(lame + shear) * gradient + shear * k.col(b).squaredNorm() * u[b];
    }
    return out;
  }
};

Eigen::Matrix<double, 6, 1> strain_of(const Matrix3d& slope) {
  Eigen::Matrix<double, 6, 1> out;
  out << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0),
      slope(1, 2) + slope(2, 1), slope(2, 0) + slope(0, 2);
  return out;
}

/// Energy norm of the error in a distorted unit cube, relative to that of the field.
double energy_error(const SolidForm& form, int divisions) {
  const ManufacturedField exact;
  const Material material = Material::isotropic(1.0, 0.3, 1.0);
  Structure s;
  add_box(s, {{0, 0, 0}, {1, 1, 1}, {divisions, divisions, divisions}}, material, form);
  for (Node& node : s.nodes) {  // a smooth map of the cube, so that refined meshes look alike
    Vector3d& x = node.position;
    x += 0.05 * Vector3d(x.y() * x.z(), x.z() * x.x() - 0.5 * x.y(), x.x() * x.y());
  }
  const FeModel fe = assemble(s);
  const Elasticity D = solid_elasticity(material);
  Vector f = Vector::Zero(fe.dofs.num_dofs);
  const QuadratureRule rule = test::fine_rule(form.kind, 5);
  const auto visit = [&](auto&& at_point) {
    for (int e = 0; e < s.solids.num_elements(); ++e) {
      const NodeVectors x = s.solids.positions(s.nodes, e);
      for (const QuadraturePoint& q : rule) {
        const SolidPoint p = solid_point(form.kind, x, q.natural);
        at_point(e, Vector3d(x * p.N), p, q.weight * p.volume);
      }
    }
  };
  visit([&](int e, const Vector3d& x, const SolidPoint& p, double dV) {
    for (int i = 0; i < p.N.size(); ++i) {
      f.segment<3>(3 * s.solids.nodes(e)[static_cast<std::size_t>(i)]) +=
          dV * p.N[i] * exact.force(x);
    }
  });
  const Vector nodal = test::nodal_values(fe, [&](const Vector3d& x) { return exact.at(x); });
  const std::vector<bool> given = held(s, {"x0", "x1", "y0", "y1", "z0", "z1"});
  Vector boundary = nodal;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (!given[k]) boundary[static_cast<Eigen::Index>(k)] = 0;
  }
  const Vector d = solve(fe, f, given, boundary);
  double error = 0, total = 0;
  visit([&](int e, const Vector3d& x, const SolidPoint& p, double dV) {
    Vector own(3 * p.N.size());
    for (int i = 0; i < p.N.size(); ++i) {
      own.segment<3>(3 * i) = d.segment<3>(3 * s.solids.nodes(e)[static_cast<std::size_t>(i)]);
    }
    const Eigen::Matrix<double, 6, 1> strain = strain_of(exact.slope(x));
    const Eigen::Matrix<double, 6, 1> wrong = solid_strain(p.gradient) * own - strain;
    error += dV * wrong.dot(D * wrong);
    total += dV * strain.dot(D * strain);
  });
  return std::sqrt(error / total);
}

class SolidsConverge : public testing::TestWithParam<SolidForm> {};

// The error in energy falls with h for linear and h² for quadratic shape functions. Incompatible
// modes leave the order as it is: the error is that of the compatible part.
TEST_P(SolidsConverge, WithTheOrderOfTheirShapeFunctions) {
  const double coarse = energy_error(GetParam(), 2), middle = energy_error(GetParam(), 4);
  const double fine = energy_error(GetParam(), 8);
  const double order = test::is_quadratic(GetParam()) ? 2.0 : 1.0;
  // Measured 0.97 … 1.03 and 1.98 … 2.04, nearer to the order in the finer pair.
  EXPECT_NEAR(std::log2(middle / fine), order, 0.02) << coarse << " " << middle << " " << fine;
  EXPECT_NEAR(std::log2(coarse / middle), order, 0.05);
}

/// Tip deflection of a clamped bar 1 × 0.05 × 0.05 m under a force at its end, over that of a
/// Timoshenko beam.
double tip_deflection(const SolidForm& form) {
  constexpr double E = 2.1e11, nu = 0.3, L = 1.0, b = 0.05, F = 1e3;
  Structure s;
  add_box(s, {{0, 0, 0}, {L, b, b}, {20, 1, 1}}, Material::isotropic(E, nu, 7850), form);
  const FeModel fe = assemble(s);
  Vector f = Vector::Zero(fe.dofs.num_dofs);
  const FaceSet* end = find_face_set(s, "x1");
  for (const ElementFace& face : end->faces) {
    const FaceIntegrals share = face_integrals(s.solids, s.nodes, face);
    for (std::size_t k = 0; k < share.nodes.size(); ++k) {
      f[3 * share.nodes[k] + 1] += F / (b * b) * share.area[static_cast<Eigen::Index>(k)];
    }
  }
  const Vector d = solve(fe, f, held(s, {"x0"}), Vector::Zero(fe.dofs.num_dofs));
  const double I = b * b * b * b / 12, G = E / (2 * (1 + nu));
  const double beam = F * L * L * L / (3 * E * I) + F * L / (5.0 / 6.0 * G * b * b);
  return f.dot(d) / F / beam;  // mean over the face, as the force does work on it
}

TEST(SlenderBars, BendWithoutLocking) {
  // 0.994, 0.990, 0.988: the clamped end hinders the contraction of the section over a length of
  // about b/4, where the bar bends with (1 − ν)/((1 + ν)(1 − 2ν)) E; that is 3 · 0.26 · b/4 / L = 1
  // %.
  EXPECT_NEAR(tip_deflection(SolidForm::usual(SolidKind::hex8)), 1.0, 0.015);
  EXPECT_NEAR(tip_deflection(SolidForm::usual(SolidKind::hex20)), 1.0, 0.015);
  EXPECT_NEAR(tip_deflection(SolidForm::usual(SolidKind::tet10)), 1.0, 0.015);
  // 0.65 and 0.22: linear shape functions take up bending by shear; incompatible modes are for
  // that.
  EXPECT_LT(tip_deflection({SolidKind::hex8, SolidIntegration::full}), 0.7);
  EXPECT_LT(tip_deflection(SolidForm::usual(SolidKind::tet4)), 0.5);
}

class SolidsBend : public testing::TestWithParam<SolidForm> {};

// Pure bending with its anticlastic curvature is quadratic: elements with bricks' shape carry it
// without error if they have quadratic terms, whether as nodes or as inner modes.
TEST_P(SolidsBend, ExactlyUnderAPureMoment) {
  Structure s;
  const Box box{{0, -0.1, -0.15}, {1.2, 0.2, 0.3}, {3, 2, 2}};
  add_box(s, box, test::steel(), GetParam());
  const FeModel fe = assemble(s);
  constexpr double curvature = 1e-3, nu = 0.3;
  const Vector d = test::nodal_values(fe, [&](const Vector3d& x) -> Vector3d {
    return curvature * Vector3d(-x.x() * x.y(),
                                0.5 * (x.x() * x.x() + nu * (x.y() * x.y() - x.z() * x.z())),
                                nu * x.y() * x.z());
  });
  const Vector force = fe.K * d;
  const double energy =
      0.5 * test::steel().E * (0.3 * std::pow(0.2, 3) / 12) * curvature * curvature * 1.2;
  if (GetParam() == SolidForm{SolidKind::hex8, SolidIntegration::full}) {
    EXPECT_GT(0.5 * d.dot(force), 1.5 * energy);  // parasitic shear
    return;
  }
  EXPECT_NEAR(0.5 * d.dot(force), energy, 1e-11 * energy);
  for (const int node : test::inner_nodes(s)) {
    EXPECT_LE(force.segment<3>(3 * node).norm(), 1e-11 * force.norm()) << "node " << node;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SolidsConverge, testing::ValuesIn(test::all_forms()),
                         [](const auto& form) { return test::form_name(form.param); });
INSTANTIATE_TEST_SUITE_P(All, SolidsBend,
                         testing::Values(SolidForm{SolidKind::hex8, SolidIntegration::full},
                                         SolidForm::usual(SolidKind::hex8),
                                         SolidForm::usual(SolidKind::hex20),
                                         SolidForm::usual(SolidKind::tet10)),
                         [](const auto& form) { return test::form_name(form.param); });

}  // namespace
}  // namespace buckens::fem
