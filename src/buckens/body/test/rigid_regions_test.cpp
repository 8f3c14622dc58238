// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/rigid_regions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/body/reduction.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

/// A block, bent by a beam at a corner so that some nodes have rotations.
struct Block {
  fem::Structure structure;
  fem::FeModel fe;
  std::vector<RigidRegion> regions;

  Block() {
    const auto material = fem::Material::isotropic(2e9, 0.3, 1200);
    fem::add_box(structure, {{0, 0, 0}, {0.5, 0.2, 0.1}, {4, 2, 2}}, material);
    const int tip = fem::add_node(structure, "tip", {0.0, 0.0, 0.4});
    fem::BeamProperties beam;
    beam.material = material;
    beam.section = fem::Section::circle(0.02);
    fem::add_beam(structure, 0, tip, 2, beam);
    fe = fem::assemble(structure);
    for (const char* name : {"x0", "x1"}) {
      const auto region = fem::face_region(structure, *fem::find_face_set(structure, name));
      regions.push_back({name, region.nodes, region.centre});
    }
  }
  std::unique_ptr<FlexiblePart> full() const {
    return std::make_unique<FlexiblePart>("block", fem::FeModel(fe), CouplingLevel::full);
  }
  std::unique_ptr<FlexiblePart> held() const {
    const auto part = full();
    return with_links("block", *part, regions).part;
  }
};

TEST(RigidRegions, KeepRigidMotionAndMass) {
  const Block block;
  const auto held = block.held();
  EXPECT_EQ(held->num_dofs(), block.fe.M.rows() - 2 * 27 - 3 + 12);
  EXPECT_EQ(held->sieve.rank(), 6);
  std::vector<Vector3d> all, own;
  for (const auto& node : block.fe.nodes) all.push_back(node.position);
  for (const auto& node : held->fe.nodes) own.push_back(node.position);
  const Matrix Phi = rigid_modes(all, block.fe.dofs, block.fe.shape.com);
  const Matrix Phi_held = rigid_modes(own, held->fe.dofs, held->fe.shape.com);
  const Matrix back = held->recovery.sparse() * Phi_held;
  EXPECT_NEAR((back - Phi).norm(), 0, 1e-13 * Phi.norm());
  const Matrix S = Phi.transpose() * (block.fe.M * Phi);
  EXPECT_NEAR((held->sieve.S() - S).norm(), 0, 1e-12 * S.norm());
  // Six motions without strain and no more.
  const Vector omega2 =
      Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(
          Matrix(held->fe.K.whole()), Matrix(held->fe.M.whole()), Eigen::EigenvaluesOnly)
          .eigenvalues();
  EXPECT_LT(omega2.head(6).cwiseAbs().maxCoeff(), 1e-8 * omega2[6]);
  EXPECT_GT(omega2[6], 1.0);
}

TEST(RigidRegions, HaveTheInertiaOfTheirNodes) {
  const Block block;
  const auto full = block.full();
  const auto held = block.held();
  const auto n = held->num_dofs();
  const Vector x = Vector::Random(n), x_dot = Vector::Random(n), x_ddot = Vector::Random(n);
  const Vector d = held->nodal(x), d_dot = held->nodal(x_dot), d_ddot = held->nodal(x_ddot);
  EXPECT_NEAR(x_dot.dot(held->fe.M * x_dot), d_dot.dot(block.fe.M * d_dot),
              1e-12 * d_dot.dot(block.fe.M * d_dot));
  const DeformedMoments found = held->invariants.moments(x, x_dot, x_ddot);
  const DeformedMoments expected = full->invariants.moments(d, d_dot, d_ddot);
  EXPECT_NEAR((found.J - expected.J).norm(), 0, 1e-12 * expected.J.norm());
  EXPECT_NEAR((found.J_dot - expected.J_dot).norm(), 0, 1e-12 * expected.J_dot.norm());
  EXPECT_NEAR((found.l - expected.l).norm(), 0, 1e-12 * expected.l.norm());
  EXPECT_NEAR((found.l_dot - expected.l_dot).norm(), 0, 1e-12 * expected.l_dot.norm());
  const Matrix3d A = Matrix3d::Random();
  Vector load = Vector::Zero(n), full_load = Vector::Zero(d.size());
  held->invariants.add_weighted(A, x, load);
  full->invariants.add_weighted(A, d, full_load);
  EXPECT_NEAR((load - held->recovery.transposed(full_load)).norm(), 0, 1e-12 * load.norm());
  // The scalar mass matrix is used for the nodes outside the regions as before.
  EXPECT_FALSE(held->fe.shape.nodal.empty());
}

/// Rows of u_i − u − θ × r_i = 0 for every node of the regions over (d, u, θ of each region), of
/// the beam's node that turns with the first region, and of the first region held.
Matrix constraint_rows(const Block& block) {
  const auto n = block.fe.M.rows();
  Matrix B = Matrix::Zero(0, n + 12);
  const auto add = [&]() -> Eigen::Index {
    B.conservativeResize(B.rows() + 1, Eigen::NoChange);
    B.bottomRows<1>().setZero();
    return B.rows() - 1;
  };
  for (Eigen::Index k = 0; k < 2; ++k) {
    const RigidRegion& region = block.regions[static_cast<std::size_t>(k)];
    for (const int node : region.nodes) {
      const Vector3d r = block.fe.nodes[static_cast<std::size_t>(node)].position - region.centre;
      const auto& dofs = block.fe.dofs.node_dofs[static_cast<std::size_t>(node)];
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Eigen::Index row = add();
        B(row, dofs[static_cast<std::size_t>(axis)]) = 1;
        B(row, n + 6 * k + axis) = -1;
        for (Eigen::Index about = 0; about < 3; ++about) {
          B(row, n + 6 * k + 3 + about) = -Vector3d::Unit(about).cross(r)[axis];
        }
      }
    }
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Index row = add();
    B(row, block.fe.dofs.node_dofs[0][static_cast<std::size_t>(3 + axis)]) = 1;
    B(row, n + 3 + axis) = -1;
  }
  for (Eigen::Index k = 0; k < 6; ++k) B(add(), n + k) = 1;
  return B;
}

TEST(RigidRegions, DeformAsUnderConstraintsWithMultipliers) {
  // Second route: the free mesh with multipliers for every node. One region is held, the other
  // pulled and turned.
  const Block block;
  const auto held = block.held();
  const auto n = block.fe.M.rows();
  const Matrix B = constraint_rows(block);
  const double stiffness = block.fe.K.diagonal().maxCoeff();  // scales the multipliers
  Matrix A = Matrix::Zero(n + 12 + B.rows(), n + 12 + B.rows());
  A.topLeftCorner(n, n) = Matrix(block.fe.K.whole());
  A.topRightCorner(n + 12, B.rows()) = stiffness * B.transpose();
  A.bottomLeftCorner(B.rows(), n + 12) = stiffness * B;
  Vector wrench(6);
  wrench << 100, -40, 30, 2, 5, -3;
  Vector right = Vector::Zero(A.rows());
  right.segment(n + 6, 6) = wrench;
  const Vector expected = A.fullPivLu().solve(right);

  const auto free = held->num_dofs() - 12;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < held->num_dofs(); ++k) {
    if (k < free || k >= free + 6) kept.push_back(k);
  }
  const Matrix K = Matrix(held->fe.K.whole())(kept, kept);
  Vector f = Vector::Zero(held->num_dofs());
  f.tail(6) = wrench;
  Vector x = Vector::Zero(held->num_dofs());
  const Vector solution = K.ldlt().solve(Vector(f(kept)));
  x(kept) = solution;
  const Vector d = held->nodal(x);
  // Rounding times the condition of the saddle-point system.
  EXPECT_NEAR((d - expected.head(n)).norm(), 0, 1e-8 * d.norm());
  EXPECT_NEAR((x.tail(6) - expected.segment(n + 6, 6)).norm(), 0, 1e-8 * x.tail(6).norm());
}

TEST(RigidRegions, FindTheNearestMotionInTheMassMetric) {
  const auto held = Block().held();
  const Vector x = Vector::Random(held->num_dofs());
  EXPECT_NEAR((held->coordinates(held->nodal(x)) - x).norm(), 0, 1e-9 * x.norm());
}

TEST(RigidRegions, CanBeReduced) {
  const auto held = Block().held();
  const auto n = held->num_dofs();
  held->rows.resize(12, n);
  for (Eigen::Index k = 0; k < 12; ++k) held->rows.insert(k, n - 12 + k) = 1.0;
  held->num_interface_rows = 12;
  const ReducedBasis basis = free_free_basis("block", *held, 6, true, 0.2);
  const auto reduced = reduce("block", *held, basis);
  EXPECT_TRUE(reduced->is_reduced());
  EXPECT_FALSE(held->is_reduced());
  EXPECT_EQ(&reduced->mesh(), &held->mesh());
  const Vector eta = Vector::Random(basis.Z.cols());
  const Vector d = held->nodal(basis.Z * eta);
  EXPECT_NEAR((reduced->nodal(eta) - d).norm(), 0, 1e-13 * d.norm());
  EXPECT_NEAR((reduced->coordinates(d) - eta).norm(), 0, 1e-9 * eta.norm());
  EXPECT_NEAR((reduced->rows * eta - held->rows * (basis.Z * eta)).norm(), 0, 1e-13 * d.norm());
}

TEST(RigidRegions, WithCommonNodesAreRefused) {
  Block block;
  block.regions[1].nodes.push_back(block.regions[0].nodes.front());
  EXPECT_THROW(block.held(), ModelError);
}

}  // namespace
}  // namespace buckens::body
