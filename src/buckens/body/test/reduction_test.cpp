// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduction.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "buckens/body/elastic_inverse.h"
#include "buckens/body/fixed_interface_modes.h"
#include "buckens/body/free_modes.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

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
  EXPECT_LE((K - Matrix(reduced->fe.K.whole())).norm(), 1e-11 * K.norm());

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
  EXPECT_LE((Matrix(reduced->C.whole()) - Z.transpose() * (full->C * Z)).norm(),
            1e-11 * Matrix(reduced->C.whole()).norm());
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
  // Loads that push and turn the whole body cause no strain: two interfaces of k rows have 2k − 6
  // independent self-equilibrated loads, the rest acts against the inertia of the body and strains
  // it, too. All 2k responses are independent.
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
  EXPECT_EQ(reduced->fe.M.whole().norm(), 0);
  EXPECT_FALSE(reduced->is_damped());
  const Eigen::Index n = reduced->num_dofs();
  EXPECT_LE(n, full->num_interface_rows + 6);
  const Vector eta = 1e-3 * wave(n, 1);
  // The inertia of the deformed shape is that of the full mesh.
  const Matrix3d J = full->invariants.rotary_inertia(reduced->nodal(eta));
  EXPECT_LE((reduced->invariants.rotary_inertia(eta) - J).norm(), 1e-12 * J.norm());
  // The response to centrifugal loads is that of the full mesh.
  const ElasticInverse inverse("thing", full->fe, full->sieve, kLength);
  const Matrix exact = inverse.solve_checked(full->invariants.centrifugal_patterns());
  const Matrix found = reduced->recovery.dense() *
                       reduced->fe.K.diagonal().cwiseInverse().asDiagonal() *
                       reduced->invariants.centrifugal_patterns();
  EXPECT_LE((found - exact).norm(), 1e-9 * exact.norm());
}

TEST_P(Reduction, HeldInterfacesVibrateAsThoseOfTheMeshWithoutTheirVariables) {
  const auto full = part(GetParam());
  const FreeModes held = fixed_interface_modes(*full, 6);
  ASSERT_EQ(held.omega.size(), 6);
  EXPECT_LE((full->rows * held.shapes).norm(), 1e-10);
  // The interface rows are single variables: the mesh without them has the same frequencies.
  std::vector<Eigen::Index> kept;
  const Matrix N = full->rows;
  for (Eigen::Index k = 0; k < full->num_dofs(); ++k) {
    if (N.col(k).isZero(0.0)) kept.push_back(k);
  }
  const Matrix M = Matrix(full->fe.M.whole())(kept, kept),
               K = Matrix(full->fe.K.whole())(kept, kept);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(K, M);
  // A motion that the interface leaves free has ω² = 0 but for rounding.
  const Vector expected = eigen.eigenvalues().head(6);
  EXPECT_LE((held.omega.cwiseAbs2() - expected).norm(), 1e-8 * expected.norm());
}

TEST_P(Reduction, CraigBamptonKeepsInterfaceAndModesLessSix) {
  const auto full = part(GetParam());
  CraigBamptonChoice choice;
  choice.modes = 5;
  choice.static_correction = false;
  const ReducedBasis bare = craig_bampton_basis("thing", *full, choice, kLength);
  EXPECT_EQ(bare.num_modes, 5);
  // Two corners of a solid do not hold it: one of its rigid motions is a vibration with ω = 0,
  // which the sieve takes out of the modes computed, not of those counted.
  const int loose = GetParam() ? 1 : 0;
  EXPECT_EQ(bare.Z.cols(), full->num_interface_rows + 5 - (6 - loose));
  const Eigen::Index n = bare.Z.cols();
  EXPECT_LE((full->sieve.P().transpose() * bare.Z).norm(), 1e-11);
  EXPECT_LE((bare.Z.transpose() * (full->fe.M * bare.Z) - Matrix::Identity(n, n)).norm(), 1e-10);
  const Matrix K = bare.Z.transpose() * (full->fe.K * bare.Z);
  EXPECT_LE((K - Matrix(K.diagonal().asDiagonal())).norm(), 1e-10 * K.norm());
  // It contains the static interface displacements.
  const Vector omega_full = free_modes(full->fe.M, full->fe.K, full->sieve.Phi(), 3).omega;
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_GE(bare.omega[k], omega_full[k] * (1.0 - 1e-9)) << "Rayleigh: from above";
    if (!GetParam()) {
      EXPECT_LE(bare.omega[k], omega_full[k] * 1.02);
    }
  }
  choice.static_correction = true;
  const ReducedBasis corrected = craig_bampton_basis("thing", *full, choice, kLength);
  EXPECT_GT(corrected.Z.cols(), n);
  EXPECT_LE(corrected.Z.cols(), n + 6);
  const auto reduced = reduce("thing", *full, corrected);
  const ElasticInverse inverse("thing", full->fe, full->sieve, kLength);
  const Matrix exact = inverse.solve_checked(full->invariants.centrifugal_patterns());
  const Matrix found = reduced->recovery.dense() *
                       reduced->fe.K.diagonal().cwiseInverse().asDiagonal() *
                       reduced->invariants.centrifugal_patterns();
  EXPECT_LE((found - exact).norm(), 1e-8 * exact.norm());
}

TEST_P(Reduction, CraigBamptonWithAllModesIsTheFullBody) {
  const auto full = part(GetParam());
  CraigBamptonChoice choice;
  choice.modes = 10000;
  const ReducedBasis basis = craig_bampton_basis("thing", *full, choice, kLength);
  EXPECT_EQ(basis.Z.cols(), full->num_dofs() - 6);
  const Vector omega = free_modes(full->fe.M, full->fe.K, full->sieve.Phi(), 10000).omega;
  EXPECT_LE((basis.omega - omega).norm(), 1e-7 * omega.norm());
}

TEST_P(Reduction, CutoffTakesAllVibrationsBelow) {
  const auto full = part(GetParam());
  const int loose = GetParam() ? 1 : 0;
  const FreeModes held = fixed_interface_modes(*full, 12);
  CraigBamptonChoice choice;
  choice.cutoff = 0.5 * (held.omega[9] + held.omega[10]);
  const ReducedBasis basis = craig_bampton_basis("thing", *full, choice, kLength);
  EXPECT_EQ(basis.num_modes, 10 - loose);
  EXPECT_NEAR(basis.highest_mode, held.omega[9], 1e-9 * held.omega[9]);
}

TEST(HeldInterfaces, IterateOnLargeMeshes) {
  // 27 × 3 × 3 nodes: 729 variables, more than the dense limit.
  fem::Structure s;
  fem::add_box(s, {{0, 0, 0}, {1.3, 0.1, 0.2}, {26, 2, 2}},
               fem::Material::isotropic(2e9, 0.3, 1200));
  FlexiblePart full("bar", fem::assemble(s), CouplingLevel::full);
  const int n = static_cast<int>(full.num_dofs());
  ASSERT_GT(n, 600);
  std::vector<Eigen::Index> face, kept;
  for (std::size_t node = 0; node < full.fe.nodes.size(); ++node) {
    auto& list = full.fe.nodes[node].position.x() == 0.0 ? face : kept;
    for (std::size_t k = 0; k < 3; ++k) list.push_back(full.fe.dofs.node_dofs[node][k]);
  }
  ASSERT_EQ(face.size(), 27u);
  full.rows.resize(27, n);
  for (int k = 0; k < 27; ++k) full.rows.insert(k, face[static_cast<std::size_t>(k)]) = 1.0;
  full.rows.makeCompressed();
  full.num_interface_rows = 27;
  const FreeModes held = fixed_interface_modes(full, 6);
  const Matrix M = Matrix(full.fe.M.whole())(kept, kept), K = Matrix(full.fe.K.whole())(kept, kept);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(K, M, Eigen::EigenvaluesOnly);
  const Vector expected = eigen.eigenvalues().head(6).cwiseSqrt();
  EXPECT_LE((held.omega - expected).norm(), 1e-8 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Meshes, Reduction, testing::Bool(),
                         [](const auto& mesh) { return mesh.param ? "Solid" : "Beam"; });

}  // namespace
}  // namespace buckens::body
