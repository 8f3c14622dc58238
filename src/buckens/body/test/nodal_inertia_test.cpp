// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_inertia.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/deformation_coupling.h"
#include "buckens/body/inertia_invariants.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/shared_matrix.h"

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
    for (Eigen::Index column = 0; column < shape.nodal.Ms->cols(); ++column) {
      for (Eigen::Index row = 0; row < shape.nodal.Ms->rows(); ++row) {
        const auto from = static_cast<std::size_t>(row);
        const auto to = static_cast<std::size_t>(column);
        out.W[k].coeffRef(shape.nodal.dofs[from][static_cast<std::size_t>(kPairs[k][0])],
                          shape.nodal.dofs[to][static_cast<std::size_t>(kPairs[k][1])]) =
            shape.nodal.Ms->coeff(row, column);
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

/// A long string of nodes, each coupled to its neighbours by inertia.
/// @param offset number of the first variable
fem::ShapeIntegrals string_of_nodes(int count, int offset) {
  fem::ShapeIntegrals out;
  std::vector<linalg::Triplet> entries;
  for (int node = 0; node < count; ++node) {
    entries.emplace_back(node, node, 4.0 + std::sin(node));
    if (node > 0) {
      entries.emplace_back(node, node - 1, 1.0 / node);
      entries.emplace_back(node - 1, node, 1.0 / node);
    }
    const int first = offset + 3 * node;
    out.nodal.dofs.push_back({first, first + 1, first + 2});
  }
  linalg::SparseMatrix Ms(count, count);
  Ms.setFromTriplets(entries.begin(), entries.end());
  out.nodal.Ms = linalg::SharedMatrix(std::move(Ms));
  return out;
}

struct Deformation {
  Vector image, load;
  DeformedMoments moments;
};

/// M d, loads and moments of a deformation in general position.
/// @param offset variables before those of the string, which belong to no node
Deformation evaluate(const fem::ShapeIntegrals& shape, int offset, TaskPool* pool) {
  const auto n = offset + 3 * shape.nodal.Ms->rows();
  Vector d(n), d_dot(n), d_ddot(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto t = static_cast<double>(i - offset);
    d[i] = 0.01 * std::sin(t);
    d_dot[i] = std::cos(3 * t);
    d_ddot[i] = 10 * std::sin(2 * t + 1);
  }
  const auto weights =
      DeformationWeights::of_motion(Vector3d(1, -2, 3), Vector3d(-0.5, 0.7, 11), {});
  Deformation out{Vector(n), Vector::Zero(n), {}};
  NodalInertia(shape.nodal).multiply(d, out.image, pool);
  out.moments = evaluate_deformation(shape, d, d_dot, d_ddot, weights, out.load, pool);
  return out;
}

TEST(NodalInertia, GivesTheSameBitsWithAnyNumberOfThreads) {
  const fem::ShapeIntegrals shape = string_of_nodes(5000, 0);
  ASSERT_TRUE(NodalInertia(shape.nodal).is_regular());
  const Deformation alone = evaluate(shape, 0, nullptr);
  for (const int threads : {2, 3}) {
    TaskPool pool(threads);
    const Deformation shared = evaluate(shape, 0, &pool);
    EXPECT_EQ(shared.image, alone.image);
    EXPECT_EQ(shared.load, alone.load);
    EXPECT_EQ(shared.moments.J, alone.moments.J);
    EXPECT_EQ(shared.moments.J_dot, alone.moments.J_dot);
    EXPECT_EQ(shared.moments.l, alone.moments.l);
    EXPECT_EQ(shared.moments.l_dot, alone.moments.l_dot);
  }
}

TEST(NodalInertia, OverwritesWhateverStoodInALoad) {
  const fem::ShapeIntegrals shape = string_of_nodes(5000, 0);
  const NodalInertia nodal(shape.nodal);
  const linalg::CommonTable common{nodal.matrix(), nullptr, nullptr};
  const Vector d = Vector::LinSpaced(3 * shape.nodal.Ms->rows(), -0.01, 0.02);
  const auto weights =
      DeformationWeights::of_motion(Vector3d(1, -2, 3), Vector3d(-0.5, 0.7, 11), {});
  Vector added = Vector::Zero(d.size());
  evaluate_deformation(shape, d, d, d, weights, added, nullptr, &common);
  ASSERT_GT(added.norm(), 0.0);
  Vector written = Vector::Constant(d.size(), NAN);
  evaluate_deformation(shape, d, d, d, weights, written, nullptr, &common, true);
  EXPECT_EQ(written, added);
}

TEST(NodalInertia, LooksVariablesUpWhereTheyAreNumberedOtherwise) {
  constexpr int kNodes = 200;
  const Deformation regular = evaluate(string_of_nodes(kNodes, 0), 0, nullptr);
  const fem::ShapeIntegrals shape = string_of_nodes(kNodes, 2);
  EXPECT_FALSE(NodalInertia(shape.nodal).is_regular());
  const Deformation found = evaluate(shape, 2, nullptr);
  const auto n = regular.load.size();
  EXPECT_EQ(found.image.head(2), Vector::Zero(2));
  // The same sums, rounded elsewhere.
  EXPECT_LE((found.image.tail(n) - regular.image).norm(), 1e-15 * regular.image.norm());
  EXPECT_LE((found.load.tail(n) - regular.load).norm(), 1e-15 * regular.load.norm());
  EXPECT_LE((found.moments.J - regular.moments.J).norm(), 1e-14 * regular.moments.J.norm());
  EXPECT_LE((found.moments.J_dot - regular.moments.J_dot).norm(),
            1e-13 * regular.moments.J_dot.norm());
}

}  // namespace
}  // namespace buckens::body
