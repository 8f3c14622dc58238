// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/mode_groups.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/fixed_interface_modes.h"
#include "buckens/body/reduced_basis.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::body {
namespace {

/// Solves nothing: the lowest of given frequencies, and notes how many were asked for.
struct Given {
  std::vector<double> omega;
  std::vector<int>* asked;

  FreeModes operator()(int count) const {
    asked->push_back(count);
    const auto found = std::min<Eigen::Index>(count, static_cast<Eigen::Index>(omega.size()));
    return {Eigen::Map<const linalg::Vector>(omega.data(), found), linalg::Matrix::Zero(2, found)};
  }
};

TEST(ModeGroups, AreTakenWhole) {
  std::vector<int> asked;
  const Given modes{{1, 2, 2 * (1 + 1e-12), 3, 4, 4, 4.0039, 4.0041, 5}, &asked};
  const auto taken = [&](int count) { return lowest_groups(count, modes).omega.size(); };
  EXPECT_EQ(taken(0), 0);
  EXPECT_EQ(taken(1), 1);
  EXPECT_EQ(taken(2), 3) << "a pair but for rounding";
  EXPECT_EQ(taken(3), 3);
  EXPECT_EQ(taken(4), 4);
  EXPECT_EQ(taken(5), 7) << "within 1e-3 of the last one";
  EXPECT_EQ(taken(9), 9);
  EXPECT_EQ(taken(1000), 9);
  EXPECT_EQ(lowest_groups(5, modes).shapes.cols(), 7);
}

TEST(ModeGroups, AskForOneMoreWhereNothingBelongsTogether) {
  std::vector<int> asked;
  lowest_groups(3, Given{{1, 2, 3, 4, 5, 6, 7, 8}, &asked});
  EXPECT_EQ(asked, std::vector<int>{4});
}

TEST(ModeGroups, UpToAFrequency) {
  std::vector<int> asked;
  const Given modes{{1, 2, 2 * (1 + 1e-12), 3, 4, 5, 6, 7, 8}, &asked};
  const auto taken = [&](double cutoff) { return groups_up_to(cutoff, 2, modes).omega.size(); };
  EXPECT_EQ(taken(0.5), 0);
  EXPECT_EQ(taken(1.5), 1);
  EXPECT_EQ(taken(2), 3) << "the second of the pair is above the cutoff by rounding";
  EXPECT_EQ(taken(5), 6);
  EXPECT_EQ(taken(100), 9);
}

/// A bar of square section with the middle of one end held: bending comes in pairs.
class SquareBar : public testing::Test {
 protected:
  SquareBar() {
    fem::Structure s;
    fem::add_box(s, {{0, 0, 0}, {1.0, 0.1, 0.1}, {4, 2, 2}},
                 fem::Material::isotropic(2e9, 0.3, 1200));
    part = std::make_unique<FlexiblePart>("bar", fem::assemble(s), CouplingLevel::full);
    std::vector<int> middle;
    for (std::size_t n = 0; n < s.nodes.size(); ++n) {
      if ((s.nodes[n].position - Eigen::Vector3d(0, 0.05, 0.05)).norm() < 1e-9) {
        middle.push_back(static_cast<int>(n));
      }
    }
    part->rows.resize(3, static_cast<int>(part->num_dofs()));
    for (int k = 0; k < 3; ++k) {
      part->rows.insert(k, part->fe.dofs.node_dofs[static_cast<std::size_t>(middle.at(0))]
                                                  [static_cast<std::size_t>(k)]) = 1.0;
    }
    part->rows.makeCompressed();
    part->num_interface_rows = 3;
  }

  std::unique_ptr<FlexiblePart> part;
};

/// Whether some of ascending frequencies end between two that are equal.
bool cuts_a_pair(const linalg::Vector& omega, Eigen::Index count) {
  return omega[count] - omega[count - 1] < 1e-6 * omega[count];
}

TEST_F(SquareBar, NoBasisCutsAPair) {
  const linalg::Vector free = free_modes(part->fe.M, part->fe.K, part->sieve.Phi(), 14).omega;
  const int loose = 3;  // the bar turns about its interface
  const linalg::Vector held = fixed_interface_modes(*part, 14 + loose).omega.tail(14);
  int cut = 0;
  for (int n = 1; n < 12; ++n) {
    const ReducedBasis basis = free_free_basis("bar", *part, n, true, 1.0);
    const bool cuts = cuts_a_pair(free, n);
    cut += cuts ? 1 : 0;
    EXPECT_EQ(basis.num_modes, cuts ? n + 1 : n);
    EXPECT_EQ(quasi_static_basis("bar", *part, n, 1.0).num_modes, basis.num_modes);
    CraigBamptonChoice choice;
    choice.modes = n;
    EXPECT_EQ(craig_bampton_basis("bar", *part, choice, 1.0).num_modes,
              cuts_a_pair(held, n) ? n + 1 : n);
    choice.modes.reset();
    choice.cutoff = held[n - 1] * (1.0 + 1e-15);
    EXPECT_FALSE(cuts_a_pair(held, craig_bampton_basis("bar", *part, choice, 1.0).num_modes));
  }
  EXPECT_GE(cut, 3) << "there are pairs to cut";
}

}  // namespace
}  // namespace buckens::body
