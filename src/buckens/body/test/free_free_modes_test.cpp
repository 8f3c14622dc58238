// SPDX-License-Identifier: Apache-2.0
// Every method of free vibration against the dense one and against closed forms.
#include "buckens/body/free_free_modes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/body/shift_estimate.h"
#include "buckens/fem/assembly/assemble.h"

namespace buckens::body {
namespace {

using linalg::Matrix;

constexpr FreeModeMethod kIterative[] = {FreeModeMethod::subspace, FreeModeMethod::augmented,
                                         FreeModeMethod::penalty, FreeModeMethod::spectra};

FlexiblePart part_of(const fem::Structure& structure) {
  return FlexiblePart("test", fem::assemble(structure), CouplingLevel::full);
}

fem::BeamProperties steel(const fem::Section& section) {
  return fem::BeamProperties::of(fem::Material::isotropic(2.1e11, 0.3, 7850.0), section,
                                 fem::BeamTheory::euler_bernoulli);
}

fem::Structure free_beam(int divisions, const fem::Section& section) {
  fem::Structure s;
  fem::add_node(s, "start", {0.1, 0, 0});
  fem::add_node(s, "end", {0.1 + 0.6, 0.8, 0});
  fem::add_beam(s, 0, 1, divisions, steel(section));
  return s;
}

/// A cubic lattice of square beams, cells along each axis; `divisions` elements per edge.
fem::Structure lattice(int cells, int divisions) {
  fem::Structure s;
  const int points = cells + 1;
  const auto index = [points](int i, int j, int k) { return (i * points + j) * points + k; };
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      for (int k = 0; k < points; ++k) fem::add_node(s, "", {0.2 * i, 0.2 * j, 0.2 * k});
    }
  }
  const auto properties = steel(fem::Section::rectangle(0.01, 0.01));
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      for (int k = 0; k < points; ++k) {
        if (i < cells) fem::add_beam(s, index(i, j, k), index(i + 1, j, k), divisions, properties);
        if (j < cells) fem::add_beam(s, index(i, j, k), index(i, j + 1, k), divisions, properties);
        if (k < cells) fem::add_beam(s, index(i, j, k), index(i, j, k + 1), divisions, properties);
      }
    }
  }
  return s;
}

void expect_modes_solve(const FlexiblePart& part, const FreeFreeModes& modes) {
  const Eigen::Index count = modes.omega.size();
  const Matrix identity = modes.shapes.transpose() * (part.fe.M * modes.shapes);
  EXPECT_LE((identity - Matrix::Identity(count, count)).norm(), 1e-9);
  const Matrix squares = modes.omega.cwiseAbs2().asDiagonal();
  const Matrix strain = modes.shapes.transpose() * (part.fe.K * modes.shapes);
  EXPECT_LE((strain - squares).norm(), 1e-8 * squares.norm());
  // Rigid motion in units of one.
  EXPECT_LE((part.sieve.P().transpose() * modes.shapes).norm(), 1e-9);
}

// Enough variables for the factor, the solves and the products to be shared.
TEST(FreeFreeModes, AreTheSameWithAnyNumberOfThreads) {
  const FlexiblePart part = part_of(lattice(4, 7));
  ASSERT_GT(part.num_dofs(), 10000);
  const FreeFreeModes alone = free_free_modes(part, {.count = 4});
  const base::AllowedThreads threads(3);
  const FreeFreeModes shared = free_free_modes(part, {.count = 4});
  EXPECT_EQ(alone.omega, shared.omega);
  EXPECT_EQ(alone.shapes, shared.shapes);
  EXPECT_EQ(alone.error, shared.error);
}

TEST(FreeFreeModes, AllMethodsAgree) {
  const FlexiblePart part = part_of(free_beam(40, fem::Section::rectangle(0.02, 0.01)));
  const FreeFreeModes dense = free_free_modes(part, {.count = 12, .method = FreeModeMethod::dense});
  for (const FreeModeMethod method : kIterative) {
    const FreeFreeModes modes = free_free_modes(part, {.count = 12, .method = method});
    EXPECT_EQ(modes.method, method);
    ASSERT_EQ(modes.omega.size(), 12) << to_string(method);
    for (Eigen::Index k = 0; k < 12; ++k) {
      // Rounding of K: ε (ω_max/ω)², 4e-7 at the lowest of 40 elements, in ω².
      EXPECT_NEAR(modes.omega[k], dense.omega[k], 1e-7 * dense.omega[k])
          << to_string(method) << " " << k;
    }
    expect_modes_solve(part, modes);
    EXPECT_LE(modes.error.maxCoeff(), 1e-6) << to_string(method);
  }
}

TEST(FreeFreeModes, SquareSectionsGiveCompletePairs) {
  const FlexiblePart part = part_of(free_beam(30, fem::Section::rectangle(0.01, 0.01)));
  const double unit = std::sqrt(2.1e11 * 0.01 * 0.01 / 12 / 7850.0);  // ω = (βL)² · unit
  const std::vector<double> beta = {4.730040744862704, 7.853204624095838, 10.995607838001671,
                                    14.137165491257464};
  for (const FreeModeMethod method : kIterative) {
    const FreeFreeModes modes = free_free_modes(part, {.count = 8, .method = method});
    ASSERT_EQ(modes.omega.size(), 8);
    for (std::size_t k = 0; k < 4; ++k) {
      const double exact = beta[k] * beta[k] * unit;
      for (const std::size_t twin : {2 * k, 2 * k + 1}) {
        // Discretisation: (βh)⁴/1440 = 3e-5 at the fourth pair.
        EXPECT_NEAR(modes.omega[static_cast<Eigen::Index>(twin)], exact, 5e-5 * exact)
            << to_string(method) << " " << twin;
      }
      EXPECT_NEAR(modes.omega[static_cast<Eigen::Index>(2 * k)],
                  modes.omega[static_cast<Eigen::Index>(2 * k + 1)], 1e-7 * exact);
    }
  }
}

TEST(FreeFreeModes, LatticeOfManyVariablesEqualsTheDenseProblem) {
  const FlexiblePart part = part_of(lattice(2, 3));  // 135 nodes, 810 variables, cubic symmetry
  const FreeFreeModes dense =
      free_free_modes(part, {.count = 40, .method = FreeModeMethod::dense, .judge = false});
  const FreeFreeModes modes = free_free_modes(part, {.count = 40});
  EXPECT_EQ(modes.method, FreeModeMethod::subspace);
  EXPECT_EQ(modes.factorisations, 1);
  ASSERT_EQ(modes.omega.size(), 40);
  for (Eigen::Index k = 0; k < 40; ++k) {
    EXPECT_NEAR(modes.omega[k], dense.omega[k], 1e-9 * dense.omega[k]) << k;
  }
  EXPECT_LE(modes.error.maxCoeff(), 1e-8);
  expect_modes_solve(part, modes);
}

TEST(FreeFreeModes, TheEstimateIsABoundAndCloseForSlenderBeams) {
  const FlexiblePart part = part_of(free_beam(24, fem::Section::rectangle(0.02, 0.01)));
  const double lowest = free_free_modes(part, 1).omega[0];
  const double bound = lowest_square_estimate(part);
  EXPECT_GE(bound, lowest * lowest);
  // A parabola bends a free beam with ω² = 720 EI/(ρA L⁴) instead of 500.56; slopes that do not
  // fit quite make it slightly softer.
  EXPECT_NEAR(bound / (lowest * lowest), 720.0 / 500.5639, 1e-2);
}

TEST(FreeFreeModes, VariablesWithoutMassAreNoModes) {
  fem::Structure massless;
  fem::add_node(massless, "start", {0, 0, 0});
  fem::add_node(massless, "end", {1, 0, 0});
  fem::add_beam(massless, 0, 1, 2,
                fem::BeamProperties::of(fem::Material::isotropic(2.1e11, 0.3, 0.0),
                                        fem::Section::rectangle(0.02, 0.01),
                                        fem::BeamTheory::euler_bernoulli));
  // Inertia about the axis at one end: a rigid motion with mass, no elastic mode.
  for (int node = 0; node < 3; ++node) {
    const Eigen::Vector3d inertia(node == 0 ? 1e-3 : 0.0, 0.0, 0.0);
    massless.masses.add(node, 0.5, inertia.asDiagonal());
  }
  const FlexiblePart part = part_of(massless);
  const FreeFreeModes dense = free_free_modes(part, 100);
  ASSERT_EQ(dense.omega.size(), 4);
  for (const FreeModeMethod method :
       {FreeModeMethod::subspace, FreeModeMethod::augmented, FreeModeMethod::penalty}) {
    const FreeFreeModes modes = free_free_modes(part, {.count = 4, .method = method});
    ASSERT_EQ(modes.omega.size(), 4) << to_string(method);
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_NEAR(modes.omega[k], dense.omega[k], 1e-9 * dense.omega[k]) << to_string(method);
    }
  }
}

TEST(FreeFreeModes, ConditionIsTheSpreadOfTheSpectrum) {
  const FlexiblePart part = part_of(free_beam(16, fem::Section::rectangle(0.02, 0.01)));
  const FreeFreeModes all = free_free_modes(part, 1000);
  const double lowest = all.omega[0];
  const double highest = all.omega[all.omega.size() - 1];
  for (const FreeModeMethod method : {FreeModeMethod::subspace, FreeModeMethod::penalty}) {
    const FreeFreeModes modes =
        free_free_modes(part, {.count = 3, .method = method, .condition = true});
    // The diagonal is scaled, and the rigid motions have the eigenvalue μ: some factor.
    const double least = modes.shift > 0.0 ? modes.shift : lowest * lowest;
    EXPECT_NEAR(std::log10(modes.condition), std::log10(highest * highest / least), 1.0)
        << to_string(method);
  }
}

TEST(FreeFreeModes, FullMatricesAreRefusedForLargeBodies) {
  const FlexiblePart part = part_of(free_beam(700, fem::Section::rectangle(0.02, 0.01)));
  try {
    free_free_modes(part, {.count = 3, .method = FreeModeMethod::dense});
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("use the method subspace"), std::string::npos);
  }
}

TEST(FreeFreeModes, CountsOfZeroAndTooManyAreHandled) {
  const FlexiblePart part = part_of(free_beam(2, fem::Section::rectangle(0.02, 0.01)));
  EXPECT_EQ(free_free_modes(part, 0).omega.size(), 0);
  for (const FreeModeMethod method :
       {FreeModeMethod::subspace, FreeModeMethod::augmented, FreeModeMethod::penalty}) {
    const FreeFreeModes modes = free_free_modes(part, {.count = 1000, .method = method});
    EXPECT_EQ(modes.omega.size(), 12) << to_string(method);
  }
}

}  // namespace
}  // namespace buckens::body
