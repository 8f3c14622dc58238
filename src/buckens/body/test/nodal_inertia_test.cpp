// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/body/inertia_invariants.h"
#include "buckens/fem/assemble.h"
#include "buckens/fem/box_mesh.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;

/// The same inertia written out as six matrices W_ab.
fem::ShapeIntegrals expanded(const fem::ShapeIntegrals& shape) {
  constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  fem::ShapeIntegrals out = shape;
  out.nodal = {};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto n = shape.c.rows();
    out.W[k].resize(n, n);
    for (Eigen::Index column = 0; column < shape.nodal.Ms.cols(); ++column) {
      for (Eigen::Index row = 0; row < shape.nodal.Ms.rows(); ++row) {
        const auto from = static_cast<std::size_t>(row);
        const auto to = static_cast<std::size_t>(column);
        out.W[k].coeffRef(shape.nodal.dofs[from][static_cast<std::size_t>(kPairs[k][0])],
                          shape.nodal.dofs[to][static_cast<std::size_t>(kPairs[k][1])]) =
            shape.nodal.Ms.coeff(row, column);
      }
    }
  }
  return out;
}

TEST(NodalInertia, EqualsTheMatricesWrittenOut) {
  fem::Structure s;
  fem::add_box(s, {{0, 0, 0}, {0.3, 0.2, 0.1}, {2, 2, 1}}, fem::Material::isotropic(1e6, 0.3, 800));
  const fem::FeModel fe = fem::assemble(s);
  const fem::ShapeIntegrals slow_shape = expanded(fe.shape);
  const InertiaInvariants fast(fe.shape), slow(slow_shape);
  const auto n = fe.M.rows();
  Vector d(n), d_dot(n), d_ddot(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i);
    d[i] = 0.01 * std::sin(t);
    d_dot[i] = std::cos(3 * t);
    d_ddot[i] = 10 * std::sin(2 * t + 1);
  }
  const Vector3d w(1, -2, 3), w_dot(-0.5, 0.7, 11);
  // Sums of the same 3000 products in another order.
  const Matrix3d J = slow.rotary_inertia(d);
  EXPECT_LE((fast.rotary_inertia(d) - J).norm(), 1e-13 * J.norm());
  const Vector3d l = slow.relative_momentum(d, d_dot);
  EXPECT_LE((fast.relative_momentum(d, d_dot) - l).norm(), 1e-12 * l.norm());
  const DeformedMoments a = fast.moments(d, d_dot, d_ddot), b = slow.moments(d, d_dot, d_ddot);
  EXPECT_LE((a.J - b.J).norm(), 1e-13 * b.J.norm());
  EXPECT_LE((a.J_dot - b.J_dot).norm(), 1e-13 * b.J_dot.norm());
  EXPECT_LE((a.l - b.l).norm(), 1e-12 * b.l.norm());
  EXPECT_LE((a.l_dot - b.l_dot).norm(), 1e-12 * b.l_dot.norm());
  const Vector load = slow.deformation_load(d, d_dot, w, w_dot);
  EXPECT_LE((fast.deformation_load(d, d_dot, w, w_dot) - load).norm(), 1e-13 * load.norm());
}

}  // namespace
}  // namespace buckens::body
