// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/elastic_inverse.h"
#include "buckens/body/mode_operator.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::MatrixSum;
using linalg::SparseMatrix;
using linalg::Vector;

constexpr double kSize = 0.2;
constexpr double kShift = 1e6;

std::unique_ptr<FlexiblePart> block() {
  fem::Structure structure;
  fem::add_box(structure, {{0, 0, 0}, {0.3, 0.2, 0.1}, {5, 4, 3}},
               fem::Material::isotropic(2e9, 0.3, 1200));
  return std::make_unique<FlexiblePart>("block", fem::assemble(structure), CouplingLevel::full);
}

Matrix waves(Eigen::Index n, Eigen::Index count) {
  Matrix out(n, count);
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    out.data()[k] = std::sin(0.3 + 1.7 * static_cast<double>(k));
  }
  return out;
}

/// A factor of the matrix that the sum is, once it has been formed.
std::shared_ptr<const linalg::Factor> factor_of_whole(const MatrixSum& A) {
  return std::make_shared<const linalg::SparseCholesky>(A.whole());
}

TEST(SumsOfMatrices, ModesComeFromThemWithTheSameBits) {
  const auto part = block();
  Matrix of_sum = waves(part->num_dofs(), 3), of_whole = of_sum;
  sieved_operator(part->fe.M, part->fe.K, part->sieve, kShift).inverse(of_sum);
  EXPECT_FALSE(part->fe.M.is_formed()) << "of M, only one number per pair of nodes is needed";
  sieved_operator(part->fe.M, part->fe.K, part->sieve, kShift, factor_of_whole).inverse(of_whole);
  EXPECT_EQ(of_sum, of_whole);
}

TEST(SumsOfMatrices, AreMultipliedTermByTerm) {
  const auto part = block();
  const ModeOperator op = sieved_operator(part->fe.M, part->fe.K, part->sieve, kShift);
  const SparseMatrix A = shifted(part->fe.K, kShift, part->fe.M).whole();
  const Vector x = waves(part->num_dofs(), 1);
  const Vector expected = A * x;
  EXPECT_LE((op.multiply(x) - expected).norm(), 1e-14 * A.norm() * x.norm());
  EXPECT_LE((op.solve(op.multiply(x)) - x).norm(), 1e-9 * x.norm());
  const Vector ones = op.scale.cwiseAbs2().cwiseProduct(Vector(A.diagonal()));
  EXPECT_LE((ones - Vector::Ones(ones.size())).cwiseAbs().maxCoeff(), 1e-14);
}

/// What held variables change is the same whether K is rewritten or something is added to it.
TEST(SumsOfMatrices, GroundABody) {
  const auto part = block();
  SparseMatrix rewritten;
  const auto keep = [&rewritten](const MatrixSum& A) {
    rewritten = A.whole();
    return linalg::make_cholesky(A);
  };
  const ElasticInverse inverse("block", part->fe, part->sieve, kSize, keep);
  ASSERT_EQ(inverse.held().size(), 6U);

  const linalg::SymmetricMatrix difference = grounding(part->fe.K, inverse.held());
  MatrixSum sum;
  sum.add(1.0, part->fe.K);
  sum.add(1.0, difference);
  const SparseMatrix added = sum.whole();
  const Matrix both = Matrix(added) - Matrix(rewritten);
  const double size = part->fe.K.diagonal().maxCoeff();
  for (const int k : inverse.held()) {
    EXPECT_NEAR(both(k, k), 0.0, 1e-15 * size);
    EXPECT_EQ(Matrix(added).row(k).cwiseAbs().sum(), std::abs(added.coeff(k, k)));
  }
  Matrix rest = both;
  rest.diagonal().setZero();
  EXPECT_EQ(rest.norm(), 0.0);

  Vector load = waves(part->num_dofs(), 1);
  const Vector expected = inverse.solve(load);
  part->sieve.apply_transposed(load);
  for (const int k : inverse.held()) load[k] = 0.0;
  linalg::make_cholesky(sum)->solve_in_place(load);
  part->sieve.apply(load);
  EXPECT_LE((load - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace
}  // namespace buckens::body
