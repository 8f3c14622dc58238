// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/mesh_solver.h"

#include <gtest/gtest.h>

#include "buckens/body/free_free_modes.h"
#include "buckens/body/mode_operator.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/predicted_factor.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

fem::Structure block(const std::array<int, 3>& divisions) {
  fem::Structure out;
  fem::Box box;
  box.size = {0.3, 0.2, 0.1};
  box.divisions = divisions;
  fem::add_box(out, box, fem::Material::isotropic(2e9, 0.3, 1200));
  return out;
}

std::unique_ptr<FlexiblePart> part(const std::array<int, 3>& divisions, SolverChoice solver) {
  auto out =
      std::make_unique<FlexiblePart>("block", fem::assemble(block(divisions)), CouplingLevel::full);
  out->solver = std::move(solver);
  return out;
}

TEST(MeshSolver, AnAutomaticChoiceGoesByMemory) {
  const auto body = part({12, 6, 6}, {SolverKind::automatic, {}});
  const SparseMatrix& K = body->fe.K;
  const SolverDecision roomy = decide_solver(body->solver, K, 1e12);
  EXPECT_FALSE(roomy.iterates);
  EXPECT_NE(roomy.why.find("direct, since no factor of 1911 variables"), std::string::npos)
      << roomy.why;

  const double peak = linalg::predict_factor(K).peak;
  const SolverDecision fits = decide_solver(body->solver, K, 1.01 * peak);
  EXPECT_FALSE(fits.iterates);
  EXPECT_NE(fits.why.find("direct, since the factor of 1911 variables is predicted to take"),
            std::string::npos)
      << fits.why;

  const bool can_iterate = linalg::missing_grid_solver().empty();
  const SolverDecision tight = decide_solver(body->solver, K, 0.99 * peak);
  EXPECT_EQ(tight.iterates, can_iterate);
  const char* told = can_iterate ? "iterative, since the factor" : "libpetsc-real-dev";
  EXPECT_NE(tight.why.find(told), std::string::npos) << tight.why;
}

TEST(MeshSolver, OtherChoicesNeedNoReason) {
  const auto body = part({2, 1, 1}, {});
  EXPECT_FALSE(decide_solver({}, body->fe.K.whole(), 1.0).iterates);
  const SolverDecision asked = decide_solver({SolverKind::iterative, {}}, body->fe.K.whole(), 1e12);
  EXPECT_TRUE(asked.iterates);
  EXPECT_EQ(asked.why, "");
}

TEST(MeshSolver, KnowsHowManyVariablesNodesHave) {
  const fem::FeModel solid = fem::assemble(block({2, 1, 1}));
  EXPECT_EQ(variables_per_node(solid.dofs, solid.M.rows()), 3);
  EXPECT_EQ(variables_per_node(solid.dofs, solid.M.rows() - 3), 1);  // of a reduced matrix
  fem::DofMap mixed = solid.dofs;
  mixed.node_dofs.back() = {-1, -1, mixed.num_dofs - 3, mixed.num_dofs - 2, mixed.num_dofs - 1, -1};
  EXPECT_EQ(variables_per_node(mixed, solid.M.rows()), 3);  // any three
  std::swap(mixed.node_dofs[0], mixed.node_dofs[1]);
  EXPECT_EQ(variables_per_node(mixed, solid.M.rows()), 1);
  EXPECT_EQ(variables_per_node({}, 0), 1);
}

class IterativeMeshTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = linalg::missing_grid_solver(); !missing.empty()) {
      GTEST_SKIP() << "no multigrid solver: " << missing;
    }
  }
};

TEST_F(IterativeMeshTest, SolvesLikeAFactor) {
  for (const char* options :
       {"", "-pc_gamg_threshold 0.01", "-pc_type jacobi", "-ksp_type preonly -pc_type cholesky"}) {
    const auto body = part({6, 4, 4}, {SolverKind::iterative, options});
    const SparseMatrix A = body->fe.K.whole() + 1e5 * body->fe.M.whole();
    const Vector load = Vector::LinSpaced(A.rows(), -1.0, 1.0).cwiseAbs2();
    const Matrix found = solver_of(*body)(A)->solve(Matrix(load));
    const Matrix expected = linalg::SparseCholesky(A).solve(Matrix(load));
    const Vector error = (found - expected).col(0);
    // The tolerance is 1e-11, as the preconditioner estimates the energy of the error; with
    // Jacobi's that is within the spread of the scaled eigenvalues.
    EXPECT_LE(std::sqrt(error.dot(A * error)), 1e-9 * std::sqrt(load.dot(expected.col(0))))
        << options;
  }
}

TEST_F(IterativeMeshTest, UnknownOptionsAreNamed) {
  const auto body =
      part({2, 2, 2}, {SolverKind::iterative, "-pc_gamg_treshold 0.01 -pc_gamg_agg_nsmooths 1"});
  try {
    make_iterative(*body, shifted(body->fe.K, 1e5, body->fe.M));
    FAIL();
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("-pc_gamg_treshold"), std::string::npos) << text;
    EXPECT_EQ(text.find("-pc_gamg_agg_nsmooths"), std::string::npos) << text;
    EXPECT_NE(text.find("correct the options of PETSc"), std::string::npos) << text;
  }
}

TEST_F(IterativeMeshTest, AndSoDoNamesThatPetscRefuses) {
  const auto body = part({2, 2, 2}, {SolverKind::iterative, "-pc_type magic"});
  EXPECT_THROW(make_iterative(*body, shifted(body->fe.K, 1e5, body->fe.M)), NumericalError);
}

TEST_F(IterativeMeshTest, FindsTheModesOfAFactor) {
  FreeModesSettings settings;
  settings.count = 5;
  settings.method = FreeModeMethod::subspace;
  const FreeFreeModes expected = free_free_modes(*part({6, 4, 3}, {}), settings);
  const FreeFreeModes found =
      free_free_modes(*part({6, 4, 3}, {SolverKind::iterative, {}}), settings);
  // The error of ω is the square of that of a shape, 1e-9; rounding of K is above both.
  for (Eigen::Index k = 0; k < 5; ++k) {
    EXPECT_NEAR(found.omega[k], expected.omega[k], 1e-10 * expected.omega[k]);
  }
}

}  // namespace
}  // namespace buckens::body
