// SPDX-License-Identifier: Apache-2.0
// Scalar springs and masses, mass matrices, rigid elements and pins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::has_note;
using test::kTetra;
using test::read_deck;
using testing::ElementsAre;

const std::string kTwins = "GRID,1\nGRID,2\nGRID,3,,0.,0.,4.\nCONM2,9,1,,1.\n";

TEST(NastranScalar, springs_between_nodes_at_one_place) {
  const auto mesh =
      read_deck(kTwins + "CELAS2,1,5.,1,1,2,1\nPELAS,7,6.,,,8,9.\nCELAS1,2,8,1,5,2,5\n");
  ASSERT_EQ(mesh.springs.size(), 2u);
  EXPECT_EQ(mesh.springs[0].stiffness(0, 0), 5.0);
  EXPECT_EQ(mesh.springs[0].stiffness.sum(), 5.0);
  EXPECT_EQ(mesh.springs[1].stiffness(4, 4), 9.0);
  EXPECT_TRUE(mesh.rigid_links.empty());
}

TEST(NastranScalar, springs_off_their_line_have_arms) {
  const auto along = read_deck(kTwins + "CELAS2,1,5.,1,3,3,3\n");
  EXPECT_TRUE(along.rigid_links.empty());
  const auto across = read_deck(kTwins + "CELAS2,1,5.,1,1,3,1\n");
  ASSERT_EQ(across.rigid_links.size(), 2u);
  EXPECT_EQ(across.positions.at(3), Vector3d(0, 0, 2));
  EXPECT_THAT(across.springs.at(0).nodes, ElementsAre(3, 4));
}

TEST(NastranScalar, points_without_mass_vanish) {
  // Three springs of 6 in a row over two points: one of 2. A point on one spring alone: nothing.
  const auto mesh = read_deck(kTwins +
                              "SPOINT,101,THRU,103\nCELAS2,1,6.,1,3,101,0\n"
                              "CELAS4,2,6.,101,102\nCELAS2,3,6.,102,,3,3\n"
                              "CELAS2,4,6.,1,1,103\n");
  ASSERT_EQ(mesh.springs.size(), 1u);
  EXPECT_NEAR(mesh.springs[0].stiffness(2, 2), 2.0, 1e-15);
  EXPECT_TRUE(has_note(mesh, "scalar points are eliminated"));
  const auto grounded = read_deck(kTwins + "CELAS2,1,6.,1,3\nCELAS2,2,6.,,,1,1\n");
  EXPECT_TRUE(grounded.springs.empty());
  EXPECT_TRUE(has_note(grounded, "to ground"));
}

TEST(NastranScalar, equal_masses_in_three_directions_are_a_point_mass) {
  const auto mesh = read_deck(
      "GRID,1\nPMASS,5,3.,6,.5\nCMASS2,1,3.,1,1\nCMASS1,2,5,1,2\nCMASS1,3,5,,,1,3\n"
      "CMASS1,4,6,1,6\nPARAM,WTMASS,2.\n");
  ASSERT_EQ(mesh.masses.size(), 1u);
  EXPECT_EQ(mesh.masses[0].mass, 6.0);
  EXPECT_EQ(mesh.masses[0].inertia, Matrix3d(Vector3d(0, 0, 1).asDiagonal()));
}

TEST(NastranScalar, a_rigid_mass_matrix_is_a_mass_with_offset) {
  // m = 2 at r = (1, 2, 3) with J = diag(10, 20, 30): the matrix written out by hand.
  // m S(r): rows (0, -6, 4), (6, 0, -2), (-4, 2, 0); J + m (r·r 1 - r rᵀ), r·r = 14.
  const auto mesh = read_deck(
      "GRID,1\n"
      "CONM1,1,1,,2.,,2.,,\n,2.,,-6.,4.,36.,6.,,-2.\n"
      ",-4.,40.,-4.,2.,,-6.,-12.,40.\n");
  ASSERT_EQ(mesh.masses.size(), 1u);
  EXPECT_EQ(mesh.masses[0].mass, 2.0);
  EXPECT_LT((mesh.masses[0].offset - Vector3d(1, 2, 3)).norm(), 1e-14);
  EXPECT_LT((mesh.masses[0].inertia - Matrix3d(Vector3d(10, 20, 30).asDiagonal())).norm(), 1e-13);
}

TEST(NastranRigid, six_components_lead_whichever_they_are) {
  for (const char* card : {"RBAR,9,1,2,123,456", "RBE1,9,1,123,2,456\n,UM,1,456,2,123",
                           "RBE1,9,1,123456\n,UM,2,123456", "CRIGD1,9,1,2",
                           "CRIGD3,9,1,123456\n,MSET,2,123456", "CRIGD2,9,1,2,123456"}) {
    const auto mesh = read_deck(kTetra + card + "\n");
    ASSERT_EQ(mesh.rigid_links.size(), 1u) << card;
    EXPECT_EQ(mesh.rigid_links[0].reference, 0) << card;
    EXPECT_THAT(mesh.rigid_links[0].nodes, ElementsAre(1)) << card;
    for (const bool is_tied : mesh.rigid_links[0].variables) EXPECT_TRUE(is_tied) << card;
  }
  const auto plate = read_deck(kTetra + "RTRPLT,9,1,2,3,,123456\n,123,,456\n");
  ASSERT_EQ(plate.rigid_links.size(), 2u);
  EXPECT_EQ(plate.rigid_links[0].reference, 1);
  EXPECT_FALSE(plate.rigid_links[0].variables[3]);
  EXPECT_FALSE(plate.rigid_links[1].variables[0]);
  EXPECT_EQ(read_deck(kTetra + "CRIGD1,9,1,2,THRU,4\n").rigid_links.size(), 3u);
}

TEST(NastranRepetition, two_equals_signs_take_the_rest_of_the_line_before) {
  const auto mesh =
      read_deck(kTetra + "GRID,8,,1.,2.,3.\nGRID,9,,1.,==\nCONM2,7,8,,2.\nCONM2,6,9,==\n");
  EXPECT_EQ(mesh.positions.at(5), Vector3d(1, 2, 3));
  ASSERT_EQ(mesh.masses.size(), 2u);
  EXPECT_EQ(mesh.masses[1].mass, 2.0);
}

TEST(NastranRigid, components_of_several_nodes_lead_a_body_that_is_rigid) {
  // Three, two and one: the other components of these nodes are free.
  const std::string deck = kTetra + "GRID,9,,3.,4.,5.\nCRIGD3,9,1,123,2,23,3,3\n,MSET,9,123456\n";
  const auto mesh = read_deck(deck + "CONM2,7,9,,1.\n,2.,,2.,,,2.\n");
  ASSERT_EQ(mesh.equations.size(), 6u);
  const Vector3d shift(0.3, -0.2, 0.7), turn(0.11, 0.5, -0.4);
  for (const auto& equation : mesh.equations) {
    EXPECT_EQ(equation.terms[0].node, 4);
    double sum = 0, largest = 0;
    for (const auto& term : equation.terms) {
      const Vector3d& place = mesh.positions[static_cast<std::size_t>(term.node)];
      const double moved =
          term.variable < 3 ? (shift + turn.cross(place))[term.variable] : turn[term.variable - 3];
      sum += term.coefficient * moved;
      largest = std::max(largest, std::abs(term.coefficient));
      EXPECT_TRUE(term.node == 4 || term.variable < 3);
    }
    EXPECT_NEAR(sum, 0.0, 1e-13 * largest);  // rounding of a system of six
  }
  // Nothing at the node turns.
  const auto still = read_deck(deck + "CONM2,7,9,,1.\n");
  ASSERT_EQ(still.equations.size(), 3u);
  for (const auto& equation : still.equations) EXPECT_LT(equation.terms[0].variable, 3);
  EXPECT_TRUE(has_note(still, "left out at nodes where nothing turns"));
  // Nothing keeps the body from turning about the line between two nodes.
  test::expect_words(
      test::refusal(kTetra + "GRID,9,,3.,4.,5.\nCRIGD3,9,1,123,2,123\n,MSET,9,123456\n"),
      {"CRIGD3", "do not hold the rigid body in place"});
}

TEST(NastranRigid, a_rigid_rod_keeps_its_length) {
  const auto mesh = read_deck(kTetra + "GRID,9,,3.,4.\nRROD,5,1,9,,1\n");
  const auto& terms = mesh.equations.at(0).terms;
  ASSERT_EQ(terms.size(), 4u);
  // The first term is eliminated: the larger part of the node with a dependent component.
  EXPECT_EQ(terms[0].node, 4);
  EXPECT_EQ(terms[0].variable, 1);
  // Displacements that leave the length as it is: across the rod, and equal ones.
  const auto residual = [&](const Vector3d& a, const Vector3d& b) {
    double sum = 0;
    for (const auto& term : terms)
      sum += term.coefficient * (term.node == 0 ? a : b)[term.variable];
    return sum;
  };
  EXPECT_NEAR(residual({0, 0, 1}, {-4, 3, 7}), 0.0, 1e-14);
  EXPECT_NEAR(residual({1, 2, 3}, {1, 2, 3}), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(residual({0, 0, 0}, {0.6, 0.8, 0})), 1.0, 1e-14);
}

TEST(NastranPins, an_end_is_tied_in_what_is_not_released) {
  const std::string beam =
      "GRID,1\nGRID,2,,3.,4.\nMAT1,1,1.,,.3\nPBAR,1,1,1.,1.,1.,1.\nCBAR,1,1,1,2,0.,0.,1.\n";
  const auto ball = read_deck(beam + ",456,56\n");
  // Three rotations free at A; at B the rotation about the beam is kept.
  ASSERT_EQ(ball.num_nodes(), 4);
  EXPECT_THAT(ball.blocks.at(0).nodes, ElementsAre(2, 3));
  ASSERT_EQ(ball.rigid_links.size(), 2u);
  EXPECT_FALSE(ball.rigid_links[0].variables[3]);
  ASSERT_EQ(ball.equations.size(), 1u);
  const auto& terms = ball.equations[0].terms;
  ASSERT_EQ(terms.size(), 4u);
  // (0.6, 0.8, 0) along the beam, the larger part eliminated.
  EXPECT_EQ(terms[0].node, 3);
  EXPECT_EQ(terms[0].variable, 4);
  EXPECT_NEAR(terms[3].coefficient, -1.0, 1e-14);
  for (const auto& term : terms) {
    if (term.variable != 3) continue;
    EXPECT_NEAR(std::abs(term.coefficient), 0.75, 1e-14);
  }
  // Free about its own axis at both ends it would spin.
  EXPECT_EQ(read_deck(beam + ",4,4\n").equations.size(), 2u);
}

TEST(NastranPoints, axial_bushes_act_along_their_line) {
  const std::string deck =
      kTetra + "CORD2R,7,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nPBUSH1D,5,40.\nCBUSH1D,8,5,2,3\n";
  const auto mesh = read_deck(deck + "CBUSH1D,9,5,1\n");
  ASSERT_EQ(mesh.springs.size(), 1u);
  const Vector3d along = Vector3d(-1, 1, 0).normalized();
  const auto& k = mesh.springs[0].stiffness;
  const Matrix3d moved = k.topLeftCorner<3, 3>(), turned = k.bottomRightCorner<3, 3>();
  EXPECT_LT((moved - 40 * along * along.transpose()).norm(), 1e-13);
  EXPECT_TRUE(turned.isZero(0.0));
  EXPECT_TRUE(has_note(mesh, "CBUSH1D: those to ground"));
  test::expect_words(test::refusal(deck + "CBUSH1D,9,5,1,4,7\n"),
                     {"x axis of CID is perpendicular to the line"});
  test::expect_words(test::refusal(deck + "CBUSH1D,9,6,1,4\n"), {"there is no PBUSH1D 6"});
}

}  // namespace
}  // namespace buckens::mesh_io
