// SPDX-License-Identifier: Apache-2.0
// Closed forms of M, W_ab, c_ab and C0 against quadrature over the volume with interpolations
// written independently, and against the paper's printed element matrices.
#include "buckens/fem/element/shape_integrals.h"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;

// Gauss–Legendre, six points on [-1, 1]: exact to degree 11.
constexpr std::array<double, 6> kPoints = {-0.932469514203152028, -0.661209386466264514,
                                           -0.238619186083196909, 0.238619186083196909,
                                           0.661209386466264514,  0.932469514203152028};
constexpr std::array<double, 6> kWeights = {0.171324492379170345, 0.360761573048138608,
                                            0.467913934572691047, 0.467913934572691047,
                                            0.360761573048138608, 0.171324492379170345};

struct Integrals {
  std::array<Matrix, 9> W;  // 3a+b
  Matrix c;
  Matrix3d C0 = Matrix3d::Zero();

  explicit Integrals(Eigen::Index n) : c(Matrix::Zero(n, 9)) { W.fill(Matrix::Zero(n, n)); }
  void add(double dm, const Vector3d& s, const Matrix& g) {
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const auto k = static_cast<std::size_t>(3 * a + b);
        W[k] += dm * g.row(a).transpose() * g.row(b);
        c.col(3 * a + b) += dm * s[a] * g.row(b).transpose();
      }
    }
    C0 += dm * s * s.transpose();
  }
  Matrix M() const { return W[0] + W[4] + W[8]; }
};

/// Element axes by Gram–Schmidt.
Matrix3d axes_of(const Vector3d& along, const Vector3d& up) {
  const Vector3d x = along.normalized();
  const Vector3d z = (up - up.dot(x) * x).normalized();
  Matrix3d E;
  E << x, z.cross(x), z;
  return E;
}

/// Friedman & Kosmatka (1993), eqs. for deflection and rotation, as printed: unit v1, θ1, v2, θ2.
std::array<double, 4> deflection(double x, double L, double Phi) {
  const double s = x / L;
  const double f = 1.0 / (1.0 + Phi);
  return {f * (2 * s * s * s - 3 * s * s - Phi * s + (1 + Phi)),
          f * L * (s * s * s - (2 + Phi / 2) * s * s + (1 + Phi / 2) * s),
          f * (-2 * s * s * s + 3 * s * s + Phi * s),
          f * L * (s * s * s - (1 - Phi / 2) * s * s - Phi / 2 * s)};
}
std::array<double, 4> rotation(double x, double L, double Phi) {
  const double s = x / L;
  const double f = 1.0 / (1.0 + Phi);
  return {f * 6 / L * (s * s - s), f * (3 * s * s - (4 + Phi) * s + (1 + Phi)),
          f * 6 / L * (s - s * s), f * (3 * s * s - (2 - Phi) * s)};
}

/// u and θ (3×12, element axes) of a beam at x.
void beam_fields(double x, double L, double Phi_y, double Phi_z, Matrix& u, Matrix& theta) {
  u = Matrix::Zero(3, 12);
  theta = Matrix::Zero(3, 12);
  for (Matrix* field : {&u, &theta}) {
    const int column = field == &u ? 0 : 3;
    (*field)(0, column) = 1 - x / L;
    (*field)(0, column + 6) = x / L;
  }
  const auto vy = deflection(x, L, Phi_y);
  const auto ry = rotation(x, L, Phi_y);
  const auto vz = deflection(x, L, Phi_z);
  const auto rz = rotation(x, L, Phi_z);
  constexpr std::array<int, 4> kY = {1, 5, 7, 11};
  constexpr std::array<int, 4> kZ = {2, 4, 8, 10};
  for (std::size_t k = 0; k < 4; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    u(1, kY[k]) = vy[k];
    theta(2, kY[k]) = ry[k];
    u(2, kZ[k]) = sign * vz[k];
    theta(1, kZ[k]) = -sign * rz[k];
  }
}

/// Integrals of the beam between two nodes that has these properties, section and all.
void integrate_beam(const FeModel& fe, int element, Integrals& out) {
  const auto& beams = dynamic_cast<const BeamBlock&>(*fe.blocks[0]);
  const auto [na, nb] = beams.ends(element);
  const BeamProperties& p = beams.properties(element);
  const Vector3d a = fe.nodes[static_cast<std::size_t>(na)].position;
  const Vector3d along = fe.nodes[static_cast<std::size_t>(nb)].position - a;
  const double L = along.norm();
  const Matrix3d E = axes_of(along, p.up.value_or(Vector3d::UnitZ()));
  const bool shear = p.theory == BeamTheory::timoshenko;
  const double area = kWidth * kHeight;
  const double flexibility =
      shear ? 12 * p.material.E / (5.0 / 6 * p.material.G * area * L * L) : 0;
  const double Phi_y = flexibility * kHeight * std::pow(kWidth, 3) / 12;
  const double Phi_z = flexibility * kWidth * std::pow(kHeight, 3) / 12;
  Matrix to_local = Matrix::Zero(12, fe.dofs.num_dofs);
  for (int end = 0; end < 2; ++end) {
    const auto& dofs = fe.dofs.node_dofs[static_cast<std::size_t>(end == 0 ? na : nb)];
    for (int k = 0; k < 6; ++k) {
      for (int i = 0; i < 3; ++i) {
        to_local(6 * end + 3 * (k / 3) + i, dofs[static_cast<std::size_t>(k)]) = E(k % 3, i);
      }
    }
  }
  Matrix u, theta;
  for (std::size_t ix = 0; ix < 6; ++ix) {
    const double x = 0.5 * L * (1 + kPoints[ix]);
    beam_fields(x, L, Phi_y, Phi_z, u, theta);
    for (std::size_t iy = 0; iy < 6; ++iy) {
      for (std::size_t iz = 0; iz < 6; ++iz) {
        const double dm =
            p.material.rho * L * area / 8 * kWeights[ix] * kWeights[iy] * kWeights[iz];
        Vector3d rho(0, 0.5 * kWidth * kPoints[iy], 0.5 * kHeight * kPoints[iz]);
        if (!p.rotary_inertia) rho.setZero();
        Matrix g = u;
        for (int k = 0; k < 12; ++k) g.col(k) += Vector3d(theta.col(k)).cross(rho);
        out.add(dm, a - fe.shape.com + E * (Vector3d(x, 0, 0) + rho), E * g * to_local);
      }
    }
  }
}

void integrate_bar(const FeModel& fe, int element, double area, Integrals& out) {
  const auto [na, nb] = fe.blocks[1]->ends(element);
  const Vector3d a = fe.nodes[static_cast<std::size_t>(na)].position;
  const Vector3d along = fe.nodes[static_cast<std::size_t>(nb)].position - a;
  for (std::size_t ix = 0; ix < 6; ++ix) {
    const double xi = 0.5 * (1 + kPoints[ix]);
    Matrix g = Matrix::Zero(3, fe.dofs.num_dofs);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      g(row, fe.dofs.node_dofs[static_cast<std::size_t>(na)][k]) = 1 - xi;
      g(row, fe.dofs.node_dofs[static_cast<std::size_t>(nb)][k]) = xi;
    }
    out.add(7850.0 * area * along.norm() / 2 * kWeights[ix], a - fe.shape.com + xi * along, g);
  }
}

/// A mass with inertia as six points on its principal axes with the same mass and inertia.
void integrate_mass(const FeModel& fe, int element, double mass, const Matrix3d& inertia,
                    Integrals& out) {
  const auto node = static_cast<std::size_t>(fe.blocks[2]->ends(element)[0]);
  const Matrix3d second = 0.5 * inertia.trace() * Matrix3d::Identity() - inertia;
  const Matrix3d root = second.llt().matrixL();
  for (int k = 0; k < 6; ++k) {
    const double side = k < 3 ? 1.0 : -1.0;
    const Vector3d rho = side * std::sqrt(3 / mass) * root.col(k % 3);
    Matrix g = Matrix::Zero(3, fe.dofs.num_dofs);
    for (int i = 0; i < 3; ++i) {
      g(i, fe.dofs.node_dofs[node][static_cast<std::size_t>(i)]) = 1;
      const int dof = fe.dofs.node_dofs[node][static_cast<std::size_t>(3 + i)];
      if (dof >= 0) g.col(dof) = Vector3d::Unit(i).cross(rho);
    }
    out.add(mass / 6, fe.nodes[node].position - fe.shape.com + rho, g);
  }
}

struct IntegralsCase {
  BeamTheory theory;
  bool rotary;
};

class ShapeIntegralsTest : public testing::TestWithParam<IntegralsCase> {};

TEST_P(ShapeIntegralsTest, ClosedFormsEqualQuadratureOverTheVolume) {
  const IntegralsCase& param = GetParam();
  const FeModel fe =
      assemble(frame_structure(beam_properties(param.theory, param.rotary), Matrix3d::Identity()));
  Integrals expected(fe.dofs.num_dofs);
  for (int e = 0; e < 3; ++e) integrate_beam(fe, e, expected);
  for (int e = 0; e < 3; ++e) integrate_bar(fe, e, M_PI * 0.005 * 0.005, expected);
  Matrix3d inertia;
  inertia << 0.05, 0.004, -0.003, 0.004, 0.06, 0.002, -0.003, 0.002, 0.04;
  integrate_mass(fe, 0, 1.7, inertia, expected);
  integrate_mass(fe, 1, 0.4, Matrix3d::Zero(), expected);

  // Sums of a few hundred products: rounding stays below 1e-13 of the largest entry.
  constexpr std::array<int, 6> kPlaces = {0, 4, 8, 1, 2, 5};
  for (std::size_t k = 0; k < 6; ++k) {
    const Matrix& W = expected.W[static_cast<std::size_t>(kPlaces[k])];
    EXPECT_LE((Matrix(fe.shape.W[k]) - W).norm(), 1e-13 * W.norm()) << "W number " << k;
  }
  EXPECT_LE((fe.shape.c - expected.c).norm(), 1e-13 * expected.c.norm());
  EXPECT_LE((fe.shape.C0 - expected.C0).norm(), 1e-13 * expected.C0.norm());
  if (param.rotary) {
    const Matrix M = expected.M();
    EXPECT_LE((Matrix(fe.M.whole()) - M).norm(), 1e-13 * M.norm());
    const Matrix3d J0 = expected.C0.trace() * Matrix3d::Identity() - expected.C0;
    EXPECT_LE((fe.shape.J0 - J0).norm(), 1e-13 * J0.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Beams, ShapeIntegralsTest,
                         testing::Values(IntegralsCase{BeamTheory::euler_bernoulli, false},
                                         IntegralsCase{BeamTheory::euler_bernoulli, true},
                                         IntegralsCase{BeamTheory::timoshenko, false},
                                         IntegralsCase{BeamTheory::timoshenko, true}));

TEST(ShapeIntegrals, FlywheelsStandInMassAndInertiaOnly) {
  // Rotary inertia off: M − ΣW_aa = ∫ρI_p θ_x θ_xᵀ dx by quadrature, J0 accordingly.
  Structure s;
  const Vector3d a(0.1, 0.2, 0.3);
  const Vector3d b(0.5, -0.4, 0.9);
  add_node(s, "a", a);
  add_node(s, "b", b);
  add_beam(s, 0, 1, 1, beam_properties(BeamTheory::euler_bernoulli, false));
  const FeModel fe = assemble(s);
  const Vector3d t = (b - a).normalized();
  const double L = (b - a).norm();
  const double inertia =
      7850.0 * kWidth * kHeight * (kWidth * kWidth + kHeight * kHeight) / 12;  // ρ I_p
  Matrix flywheel = Matrix::Zero(12, 12);
  for (std::size_t k = 0; k < 6; ++k) {
    const double xi = 0.5 * (1 + kPoints[k]);
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(12);
    theta.segment<3>(3) = (1 - xi) * t;
    theta.segment<3>(9) = xi * t;
    flywheel += inertia * L / 2 * kWeights[k] * theta * theta.transpose();
  }
  const Matrix line = fe.shape.W[0] + fe.shape.W[1] + fe.shape.W[2];
  EXPECT_LE((Matrix(fe.M.whole()) - line - flywheel).norm(), 1e-13 * flywheel.norm());
  const Matrix3d J0 =
      fe.shape.C0.trace() * Matrix3d::Identity() - fe.shape.C0 + inertia * L * t * t.transpose();
  EXPECT_LE((fe.shape.J0 - J0).norm(), 1e-14 * J0.norm());
}

TEST(ShapeIntegrals, PlanarElementsEqualThePrintedOnes) {
  // FM (54) and (56) with their misprints corrected, for two beams in the plane.
  Structure s;
  const std::array<Vector3d, 3> x = {Vector3d(0.1, 0.2, 0), Vector3d(0.8, 0.5, 0),
                                     Vector3d(1.0, -0.3, 0)};
  for (const Vector3d& position : x) add_node(s, "", position);
  const int properties =
      s.beams.add_properties(beam_properties(BeamTheory::euler_bernoulli, false));
  s.beams.add(0, 1, properties);
  s.beams.add(1, 2, properties);
  const FeModel fe = assemble(s, spatial::Plane::xy);
  ASSERT_EQ(fe.dofs.num_dofs, 9);

  Eigen::VectorXd n = Eigen::VectorXd::Zero(9);
  Matrix H = Matrix::Zero(9, 9);
  for (int e = 0; e < 2; ++e) {
    const Vector3d& a = x[static_cast<std::size_t>(e)];
    const Vector3d& b = x[static_cast<std::size_t>(e) + 1];
    const double l = (b - a).norm();
    const double cosine = (b - a).x() / l;
    const double sine = (b - a).y() / l;
    const Vector3d centre = 0.5 * (a + b) - fe.shape.com;
    const double Y = centre.x() * cosine + centre.y() * sine;
    const double X = centre.x() * sine - centre.y() * cosine;
    const double mass = 7850.0 * kWidth * kHeight * l;
    Eigen::Matrix<double, 6, 1> ne;
    ne << 6 * Y - l, -6 * X, -l * X, 6 * Y + l, -6 * X, l * X;
    Eigen::Matrix<double, 6, 6> he;
    he << 0, 21, 3 * l, 0, 9, -2 * l,  //
        -21, 0, 0, -9, 0, 0,           //
        -3 * l, 0, 0, -2 * l, 0, 0,    //
        0, 9, 2 * l, 0, 21, -3 * l,    //
        -9, 0, 0, -21, 0, 0,           //
        2 * l, 0, 0, 3 * l, 0, 0;
    Matrix T = Matrix::Zero(6, 9);
    for (int end = 0; end < 2; ++end) {
      T.block(3 * end, 3 * (e + end), 2, 2) << cosine, sine, -sine, cosine;
      T(3 * end + 2, 3 * (e + end) + 2) = 1;
    }
    n += mass / 12 * T.transpose() * ne;
    H += mass / 60 * T.transpose() * he * T;
  }
  EXPECT_LE((fe.shape.c.col(0) + fe.shape.c.col(4) - n).norm(), 1e-14 * n.norm());
  const Matrix W12 = fe.shape.W[3];
  EXPECT_LE((W12 - W12.transpose() - H).norm(), 1e-14 * H.norm());
}

}  // namespace
}  // namespace buckens::fem::test
