// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/body/elastic_inverse.h"
#include "buckens/fem/assemble.h"
#include "buckens/fem/box_mesh.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

constexpr double kLength = 0.2;

/// A bent beam with the rows of both ends as its interface, or a block with those of two corners.
std::unique_ptr<FlexiblePart> part(bool solid) {
  fem::Structure s;
  fem::Material material = fem::Material::isotropic(2e9, 0.3, 1200);
  material.damping_stiffness = 1e-4;
  if (solid) {
    fem::add_box(s, {{0, 0, 0}, {0.3, 0.2, 0.1}, {2, 2, 1}}, material);
  } else {
    for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(0.5, 0, 0), Vector3d(0.5, 0.4, 0.1)}) {
      fem::add_node(s, "", p);
    }
    auto properties = fem::BeamProperties::of(material, fem::Section::rectangle(0.02, 0.01),
                                              fem::BeamTheory::timoshenko);
    fem::add_beam(s, 0, 1, 2, properties);
    fem::add_beam(s, 1, 2, 2, properties);
  }
  auto out = std::make_unique<FlexiblePart>("thing", fem::assemble(s), CouplingLevel::full);
  const int width = solid ? 3 : 6;
  const int n = static_cast<int>(out->num_dofs());
  out->rows.resize(2 * width, n);
  for (int k = 0; k < width; ++k) {
    out->rows.insert(k, k) = 1.0;
    const int last = solid ? n - width + k : 2 * width + k;  // the beam's third node
    out->rows.insert(width + k, last) = 1.0;
  }
  out->rows.makeCompressed();
  out->num_interface_rows = 2 * width;
  return out;
}

Vector wave(Eigen::Index n, double phase) {
  Vector out(n);
  for (Eigen::Index k = 0; k < n; ++k) out[k] = std::sin(phase + 1.7 * static_cast<double>(k));
  return out;
}

class Reduction : public testing::TestWithParam<bool> {};

TEST_P(Reduction, WithAllModesIsTheFullBody) {
  const auto full = part(GetParam());
  const int elastic = static_cast<int>(full->num_dofs()) - 6;
  const ReducedBasis basis = free_free_basis("thing", *full, 10000, true, kLength);
  EXPECT_EQ(basis.num_modes, elastic);
  EXPECT_EQ(basis.num_residuals, 0) << "nothing is left beyond all modes";
  const auto reduced = reduce("thing", *full, basis);
  EXPECT_EQ(reduced->num_dofs(), elastic);
  EXPECT_EQ(reduced->sieve.rank(), 0);
  const Matrix& Z = reduced->recovery.dense();
  EXPECT_LE((full->sieve.P().transpose() * Z).norm(), 1e-12);
  EXPECT_LE((Z.transpose() * (full->fe.M * Z) - Matrix::Identity(elastic, elastic)).norm(), 1e-11);
  const Matrix K = Z.transpose() * (full->fe.K * Z);
  EXPECT_LE((K - Matrix(reduced->fe.K)).norm(), 1e-11 * K.norm());

  const Vector eta = 1e-3 * wave(elastic, 1), rate = wave(elastic, 2),
               acceleration = wave(elastic, 3);
  const Vector d = reduced->nodal(eta), d_dot = reduced->nodal(rate),
               d_ddot = reduced->nodal(acceleration);
  EXPECT_LE((reduced->coordinates(d) - eta).norm(), 1e-11 * eta.norm());
  const Vector3d w(3, -1, 2), w_dot(0.4, 7, -5);
  const DeformedMoments a = reduced->invariants.moments(eta, rate, acceleration);
  const DeformedMoments b = full->invariants.moments(d, d_dot, d_ddot);
  EXPECT_LE((a.J - b.J).norm(), 1e-12 * b.J.norm());
  EXPECT_LE((a.J_dot - b.J_dot).norm(), 1e-11 * b.J_dot.norm());
  EXPECT_LE((a.l - b.l).norm(), 1e-11 * b.l.norm() + 1e-15);
  EXPECT_LE((a.l_dot - b.l_dot).norm(), 1e-11 * b.l_dot.norm() + 1e-15);
  const Vector load = Z.transpose() * full->invariants.deformation_load(d, d_dot, w, w_dot);
  EXPECT_LE((reduced->invariants.deformation_load(eta, rate, w, w_dot) - load).norm(),
            1e-11 * load.norm());
  EXPECT_LE((reduced->invariants.centrifugal_patterns() -
             Z.transpose() * full->invariants.centrifugal_patterns())
                .norm(),
            1e-12);
  EXPECT_LE((reduced->rows * eta - full->rows * d).norm(), 1e-12 * d.norm());
  EXPECT_LE((Matrix(reduced->C) - Z.transpose() * (full->C * Z)).norm(),
            1e-11 * Matrix(reduced->C).norm());
}

TEST_P(Reduction, StaticCorrectionAnswersInterfaceLoadsExactly) {
  const auto full = part(GetParam());
  const SparseMatrix N = full->rows;
  const ElasticInverse inverse("thing", full->fe, full->sieve, kLength);
  const Matrix exact = N * inverse.solve_checked(Matrix(SparseMatrix(N.transpose())));
  const auto compliance = [&](bool corrected) {
    const auto reduced =
        reduce("thing", *full, free_free_basis("thing", *full, 3, corrected, kLength));
    const Matrix rows = reduced->rows;
    return Matrix(rows * reduced->fe.K.diagonal().cwiseInverse().asDiagonal() * rows.transpose());
  };
  // cond(K) of 1e6 … 1e8 times rounding.
  EXPECT_LE((compliance(true) - exact).norm(), 1e-9 * exact.norm());
  EXPECT_GE((compliance(false) - exact).norm(), 1e-2 * exact.norm());
}

TEST_P(Reduction, CountsItsCoordinates) {
  const auto full = part(GetParam());
  const ReducedBasis bare = free_free_basis("thing", *full, 4, false, kLength);
  EXPECT_EQ(bare.num_modes, 4);
  EXPECT_EQ(bare.num_residuals, 0);
  EXPECT_EQ(bare.Z.cols(), 4);
  // Loads that push and turn the whole body strain nothing: two interfaces of k rows have 2k − 6
  // independent self-equilibrated loads, the rest acts against the inertia of the body and strains
  // it, too. All 2k answers are independent.
  const ReducedBasis corrected = free_free_basis("thing", *full, 4, true, kLength);
  EXPECT_EQ(corrected.num_residuals, full->num_interface_rows);
  EXPECT_EQ(corrected.omega.size(), 4 + full->num_interface_rows);
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_NEAR(corrected.omega[k], bare.omega[k], 1e-9 * bare.omega[k])
        << "modes stay as they are";
  }
}

TEST_P(Reduction, QuasiStaticBodiesHaveNoInertiaOfTheirOwn) {
  auto full = part(GetParam());
  full->is_quasi_static = true;
  const auto reduced = reduce("thing", *full, quasi_static_basis("thing", *full, 0, kLength));
  EXPECT_EQ(reduced->fe.M.norm(), 0);
  EXPECT_FALSE(reduced->is_damped());
  const Eigen::Index n = reduced->num_dofs();
  EXPECT_LE(n, full->num_interface_rows + 6);
  const Vector eta = 1e-3 * wave(n, 1), rate = wave(n, 2);
  EXPECT_LE(reduced->invariants.relative_momentum(eta, rate).norm(), 1e-15);
  // The inertia of the deformed shape is that of the full mesh.
  const Matrix3d J = full->invariants.rotary_inertia(reduced->nodal(eta));
  EXPECT_LE((reduced->invariants.rotary_inertia(eta) - J).norm(), 1e-12 * J.norm());
  // Centrifugal loads are answered as by the full mesh.
  const ElasticInverse inverse("thing", full->fe, full->sieve, kLength);
  const Matrix exact = inverse.solve_checked(full->invariants.centrifugal_patterns());
  const Matrix found = reduced->recovery.dense() *
                       reduced->fe.K.diagonal().cwiseInverse().asDiagonal() *
                       reduced->invariants.centrifugal_patterns();
  EXPECT_LE((found - exact).norm(), 1e-9 * exact.norm());
}

INSTANTIATE_TEST_SUITE_P(Meshes, Reduction, testing::Bool(),
                         [](const auto& mesh) { return mesh.param ? "Solid" : "Beam"; });

}  // namespace
}  // namespace buckens::body
