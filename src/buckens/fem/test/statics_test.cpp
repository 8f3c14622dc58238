// SPDX-License-Identifier: Apache-2.0
// Patch tests: end loads on a cantilever give the exact deflections for any number of elements.
#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

constexpr double kLength = 0.4;  // short enough that shear matters

struct Cantilever {
  FeModel fe;
  Vector d;

  /// Loads on the tip in local axes: three forces, three moments; clamped at the start.
  Cantilever(BeamTheory theory, int divisions, const Eigen::Matrix<double, 6, 1>& load,
             const Eigen::Matrix3d& R) {
    Structure s;
    BeamProperties properties = beam_properties(theory, false);
    properties.up = R.col(2);
    add_node(s, "start", R * Vector3d(0.2, 0, 0));
    add_node(s, "end", R * Vector3d(0.2 + kLength, 0, 0));
    add_beam(s, 0, 1, divisions, properties);
    fe = assemble(s);
    const int n = fe.dofs.num_dofs;
    Vector f = Vector::Zero(n);
    f.segment<3>(6) = R * load.head<3>();
    f.segment<3>(9) = R * load.tail<3>();
    const Matrix K = fe.K.whole();
    d = Vector::Zero(n);
    d.tail(n - 6) = K.bottomRightCorner(n - 6, n - 6).ldlt().solve(f.tail(n - 6));
  }
  Eigen::Matrix<double, 6, 1> tip(const Eigen::Matrix3d& R) const {
    Eigen::Matrix<double, 6, 1> q;
    q << R.transpose() * d.segment<3>(6), R.transpose() * d.segment<3>(9);
    return q;
  }
};

class CantileverTest : public testing::TestWithParam<BeamTheory> {};

TEST_P(CantileverTest, TipMovesExactly) {
  const double L = kLength;
  const Section s = rectangle();
  const Material m = steel();
  const bool shear = GetParam() == BeamTheory::timoshenko;
  const double by_y = shear ? L / (5.0 / 6 * m.G * s.A) : 0;
  Eigen::Matrix<double, 6, 1> load;
  load << 5000, 700, -300, 40, 25, -60;
  // Superposition of the textbook cases; θ_y = −w′.
  Eigen::Matrix<double, 6, 1> expected;
  expected[0] = load[0] * L / (m.E * s.A);
  expected[1] =
      load[1] * (L * L * L / (3 * m.E * s.Iz) + by_y) + load[5] * L * L / (2 * m.E * s.Iz);
  expected[2] =
      load[2] * (L * L * L / (3 * m.E * s.Iy) + by_y) - load[4] * L * L / (2 * m.E * s.Iy);
  expected[3] = load[3] * L / (m.G * s.J);
  expected[4] = load[4] * L / (m.E * s.Iy) - load[2] * L * L / (2 * m.E * s.Iy);
  expected[5] = load[5] * L / (m.E * s.Iz) + load[1] * L * L / (2 * m.E * s.Iz);
  for (const int divisions : {1, 2, 7}) {
    for (const Eigen::Matrix3d& R :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), some_rotation()}) {
      const Cantilever beam(GetParam(), divisions, load, R);
      // Condition of the clamped stiffness ~ 1e5 (seven elements): 1e-11 leaves a decade.
      EXPECT_LE((beam.tip(R) - expected).norm(), 1e-11 * expected.norm()) << divisions;
    }
  }
}

TEST_P(CantileverTest, SectionForcesBalanceTheTipLoad) {
  Eigen::Matrix<double, 6, 1> load;
  load << 5000, 700, -300, 40, 25, -60;
  const Eigen::Matrix3d R = some_rotation();
  const Cantilever beam(GetParam(), 4, load, R);
  const Recovery recovery(beam.fe);
  const Matrix forces = recovery.section_forces(beam.d);
  ASSERT_EQ(forces.cols(), 4);
  for (int e = 0; e < 4; ++e) {
    for (int end = 0; end < 2; ++end) {
      // The part beyond the cut is loaded at the tip: its resultants in the cut.
      const double arm = kLength * (4 - e - end) / 4;
      Eigen::Matrix<double, 6, 1> expected = load;
      expected[4] -= arm * load[2];
      expected[5] += arm * load[1];
      EXPECT_LE((forces.block<6, 1>(6 * end, e) - expected).norm(), 1e-9 * load.norm()) << e;
    }
  }
  // σ_x at the clamp from the textbook, at the worst corner.
  const double bending_y = std::abs(load[4] - kLength * load[2]) * 0.5 * kHeight / rectangle().Iy;
  const double bending_z = std::abs(load[5] + kLength * load[1]) * 0.5 * kWidth / rectangle().Iz;
  const double normal = load[0] / rectangle().A + bending_y + bending_z;
  const Matrix stress = recovery.stresses(forces);
  EXPECT_NEAR(stress(0, 0), normal, 1e-9 * normal);
  const double shear =
      40 / rectangle().torsion_modulus + 1.5 * std::hypot(700, 300) / rectangle().A;
  EXPECT_NEAR(stress(1, 0), std::sqrt(normal * normal + 3 * shear * shear), 1e-9 * normal);
}

TEST_P(CantileverTest, InterpolationIsTheStaticSolution) {
  // A point inside one element moves like a node of a finer mesh under the same end loads.
  Eigen::Matrix<double, 6, 1> load;
  load << 5000, 700, -300, 40, 25, -60;
  const Eigen::Matrix3d R = some_rotation();
  const Cantilever coarse(GetParam(), 1, load, R);
  const Cantilever fine(GetParam(), 4, load, R);
  for (int k = 1; k < 4; ++k) {
    const PointRows rows = point_rows(coarse.fe, 0, k / 4.0);
    EXPECT_TRUE(rows.has_rotation);
    Vector3d u = Vector3d::Zero();
    Vector3d theta = Vector3d::Zero();
    for (const auto& entry : rows.translation)
      u[entry.row()] += entry.value() * coarse.d[entry.col()];
    for (const auto& entry : rows.rotation)
      theta[entry.row()] += entry.value() * coarse.d[entry.col()];
    const int node = 1 + k;  // the dividing nodes follow the two ends
    EXPECT_LE((rows.position - fine.fe.nodes[static_cast<std::size_t>(node)].position).norm(),
              1e-15);
    EXPECT_LE((u - fine.d.segment<3>(6 * node)).norm(), 1e-11 * fine.d.norm());
    EXPECT_LE((theta - fine.d.segment<3>(6 * node + 3)).norm(), 1e-11 * fine.d.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Theories, CantileverTest,
                         testing::Values(BeamTheory::euler_bernoulli, BeamTheory::timoshenko));

TEST(Recovery, BarCarriesItsAxialForce) {
  Structure s;
  add_node(s, "a", {0, 0, 0});
  add_node(s, "b", {0.3, 0.4, 0});
  s.bars.add(0, 1, steel(), Section::area(1e-4));
  const FeModel fe = assemble(s);
  Vector d = Vector::Zero(6);
  d.tail<3>() = 1e-3 * Vector3d(0.6, 0.8, 0) + 0.02 * Vector3d(-0.8, 0.6, 0);  // stretch, swing
  const Recovery recovery(fe);
  const Matrix forces = recovery.section_forces(d);
  const double N = 2.1e11 * 1e-4 * 1e-3 / 0.5;
  EXPECT_NEAR(forces(0, 0), N, 1e-12 * N);
  EXPECT_NEAR(forces(6, 0), N, 1e-12 * N);
  EXPECT_NEAR(forces.col(0).norm(), std::sqrt(2.0) * N, 1e-12 * N);
  EXPECT_NEAR(recovery.stresses(forces)(0, 0), N / 1e-4, 1e-12 * N / 1e-4);
  EXPECT_NEAR((fe.K * d).norm(), std::sqrt(2.0) * N, 1e-12 * N);
  const PointRows middle = point_rows(fe, 0, 0.5);
  EXPECT_FALSE(middle.has_rotation);
  EXPECT_THROW(point_rows(fe, 1, 0.5), ModelError);
  EXPECT_THROW(point_rows(fe, 0, 1.5), ModelError);
  ASSERT_EQ(line_elements(fe).size(), 1u);
  EXPECT_FALSE(line_elements(fe)[0].bends);
}

TEST(Recovery, NodeRowsPickTheVariables) {
  const FeModel fe =
      assemble(frame_structure(beam_properties(BeamTheory::timoshenko, true), some_rotation()),
               spatial::Plane::xy);
  const PointRows rows = node_rows(fe, 1);
  ASSERT_EQ(rows.translation.size(), 2u);
  ASSERT_EQ(rows.rotation.size(), 1u);
  EXPECT_EQ(rows.rotation[0].row(), 2);
  EXPECT_EQ(rows.rotation[0].col(), fe.dofs.node_dofs[1][5]);
  EXPECT_TRUE(rows.has_rotation);
}

TEST(LineFrame, FollowsTheHint) {
  EXPECT_TRUE(line_frame({0, 0, 0}, {2, 0, 0}, std::nullopt).axes.isIdentity(1e-15));
  const LineFrame upright = line_frame({0, 0, 0}, {0, 0, 2}, std::nullopt);
  EXPECT_TRUE(upright.axes.col(2).isApprox(Vector3d::UnitY(), 1e-15));
  EXPECT_TRUE(upright.axes.col(1).isApprox(Vector3d::UnitX(), 1e-15));
  const LineFrame oblique = line_frame({0, 0, 0}, {1, 2, 3}, Vector3d(0, 1, 0));
  EXPECT_NEAR(oblique.axes.determinant(), 1, 1e-15);
  EXPECT_GT(oblique.axes(1, 2), 0);
}

}  // namespace
}  // namespace buckens::fem::test
