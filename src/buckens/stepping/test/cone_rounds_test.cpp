// SPDX-License-Identifier: Apache-2.0
// Impulses of places that wedge each other, for which Newton's method and sweeps go to and fro: by
// convex problems, against the conditions of these and of Coulomb.
#include "buckens/stepping/cone_rounds.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/stepping/cone_program.h"
#include "buckens/stepping/friction_impulses.h"

namespace buckens::stepping {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

struct Ball {
  double mass, radius, inertia;
};

/// Where a ball touches another one, or the ground: −1.
struct Touching {
  int first, second;
  Vector3d normal;   ///< towards the second
  double asked = 0;  ///< rate across that the impulses have to make
  Vector3d slip = Vector3d::Zero();
};

struct Cluster {
  Matrix D;
  Vector b;
  std::vector<ImpactSlip> slips;
  std::vector<ConeRows> places;

  Cluster(const std::vector<Ball>& balls, const std::vector<Touching>& touching, double mu)
      : b(3 * std::ssize(touching)) {
    const Eigen::Index count = std::ssize(touching);
    Matrix J = Matrix::Zero(3 * count, 6 * std::ssize(balls));  // times the root of the mobility
    for (Eigen::Index k = 0; k < count; ++k) {
      const Touching& own = touching[static_cast<std::size_t>(k)];
      const Vector3d n = own.normal.normalized(), x = n.unitOrthogonal();
      const Eigen::Index along = count + 2 * k;
      slips.push_back({k, along, 2, mu});
      places.push_back({{k, along, along + 1}, mu});
      b[k] = own.asked;
      const auto set = [&](Eigen::Index row, const Vector3d& u) {
        const auto move = [&](int ball, double sign) {
          if (ball < 0) return;
          const Ball& moved = balls[static_cast<std::size_t>(ball)];
          const Vector3d turn = (-sign * moved.radius * n).cross(u);
          J.block<1, 3>(row, 6 * ball) = sign / std::sqrt(moved.mass) * u.transpose();
          J.block<1, 3>(row, 6 * ball + 3) = sign / std::sqrt(moved.inertia) * turn.transpose();
        };
        move(own.first, -1.0);
        move(own.second, 1.0);
        if (row != k) b[row] = -own.slip.dot(u);
      };
      set(k, n);
      set(along, x);
      set(along + 1, n.cross(x));
    }
    D = J * J.transpose();
  }
};

/// By how much impulses leave their cones and bodies approach each other, as a share of the largest
/// rate.
double outside_of(const Cluster& cluster, const Vector& P) {
  const Vector w = cluster.D * P - cluster.b;
  double outside = 0;
  for (const ImpactSlip& slip : cluster.slips) {
    const double press = P[slip.across], rub = P.segment(slip.first, 2).norm();
    const double d = cluster.D(slip.across, slip.across);
    outside = std::max({outside, -w[slip.across], d * (rub - slip.coefficient * press)});
  }
  return outside / cluster.b.cwiseAbs().maxCoeff();
}

/// What is open of (I1) and (I2), as a share of the largest rate.
double open_of(const Cluster& cluster, const Vector& P) {
  const Vector w = cluster.D * P - cluster.b;
  const double size = cluster.b.cwiseAbs().maxCoeff();
  double open = 0;
  for (const ImpactSlip& slip : cluster.slips) {
    const double d = cluster.D(slip.across, slip.across);
    const double press = d * P[slip.across], parts = w[slip.across];
    const Vector rub = d * P.segment(slip.first, 2);
    const Vector v = w.segment(slip.first, 2);
    const double most = slip.coefficient * press;
    open = std::max({open, -press, -parts, std::min(press, std::abs(parts)), rub.norm() - most});
    // It stops, or slides on against the whole of the friction.
    if (v.norm() > 1e-7 * size) open = std::max(open, (rub + most * v.normalized()).norm());
  }
  return open / size;
}

/// Balls of wood and glass in a tray, to three digits of a run: three of them in a row between two
/// walls that is nearly straight. The first one strikes the ground.
Cluster wedged_row() {
  const Ball wood{0.06437, 0.028, 20.19e-6}, glass{0.08378, 0.020, 13.4e-6};
  return {{wood, wood, glass, wood},
          {
              {-1, 0, {0, 0, 1}, 0.014, {-5.48e-3, 10.5e-3, 0}},
              {-1, 2, {1, 0, 0}, 8.76e-5, {0, -3.65e-4, -24.4e-3}},
              {-1, 0, {0, 1, 0}, -1.69e-5, {0, 0, -24.5e-3}},
              {-1, 1, {0, -1, 0}, 0, {-2.7e-3, 0, -6.05e-3}},
              {0, 2, {-0.177, 0.979, 0.0975}, 2.39e-4, {-3.32e-5, -3.35e-7, -5.69e-5}},
              {1, 3, {0.775, -0.454, 0.439}, -8.13e-5, {18.1e-3, 0.112, 83.7e-3}},
              {1, 2, {-0.178, -0.979, 0.0975}, -3.77e-7, {3.47e-3, -1.4e-3, -7.7e-3}},
          },
          0.3};
}

TEST(ConeRounds, FindWhatWedgesItselfInATray) {
  const Cluster row = wedged_row();
  const linalg::SparseMatrix D = row.D.sparseView();
  const Vector P = solve_impact(D, row.b, std::ssize(row.slips), row.slips);
  EXPECT_LT(open_of(row, P), 1e-12);
  // Nothing is gained.
  EXPECT_LT(P.dot(0.5 * row.D * P - row.b), 0.0);
}

TEST(ConeRounds, TellHowTheyEnd) {
  const Cluster row = wedged_row();
  const linalg::SparseMatrix D = row.D.sparseView();
  Vector P;
  const auto never = [](Vector&) { return false; };
  EXPECT_EQ(find_in_cones(D, row.b, row.places, never, P), ConeEnd::near);
  EXPECT_LT(outside_of(row, P), 2e-6);  // the share that is told of, and rounding
  const auto newton = [&](Vector& near) { return find_by_newton(row.D, row.b, row.places, near); };
  EXPECT_EQ(find_in_cones(D, row.b, row.places, newton, P), ConeEnd::exact);
  EXPECT_LT(open_of(row, P), 1e-12);
}

/// Balls that touch in any directions and move at random, without a rebound: they may all stand
/// still in the end, so there are impulses.
Cluster random_cluster(std::mt19937& random, int balls, int touching, double mu) {
  std::uniform_real_distribution<double> between(-1, 1);
  const auto any = [&] { return Vector3d(between(random), between(random), between(random)); };
  const Ball ball{1.0, 1.0, 0.4};
  std::vector<Vector3d> v, spin;
  for (int k = 0; k < balls; ++k) {
    v.push_back(any());
    spin.push_back(any());
  }
  std::vector<Touching> all;
  for (int k = 0; k < touching; ++k) {
    Touching own{-1, k % balls, any().normalized()};
    own.first = static_cast<int>(0.5 * (between(random) + 1.0) * (balls + 1)) - 1;
    if (own.first == own.second) own.first = -1;
    const auto at = [&](int n, double sign) -> Vector3d {
      const auto i = static_cast<std::size_t>(n);
      return v[i] + spin[i].cross(-sign * own.normal);
    };
    Vector3d rate = at(own.second, 1.0);
    if (own.first >= 0) rate -= at(own.first, -1.0);
    own.asked = -rate.dot(own.normal);
    own.slip = rate;
    all.push_back(own);
  }
  return {std::vector<Ball>(static_cast<std::size_t>(balls), ball), all, mu};
}

TEST(ConeRounds, FindWhatClustersOfBallsDo) {
  std::mt19937 random(2);
  int of_coulomb = 0;
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Cluster cluster = random_cluster(random, 6, 21, 0.5);
    const linalg::SparseMatrix D = cluster.D.sparseView();
    bool is_near = false;
    const Vector P =
        solve_impact(D, cluster.b, std::ssize(cluster.slips), cluster.slips, nullptr, &is_near);
    // Where rounds lead away from the end, what slides parts or closes by a millionth, and it is
    // told.
    EXPECT_LT(outside_of(cluster, P), is_near ? 2e-6 : 1e-9) << trial;
    EXPECT_LT(P.dot(0.5 * cluster.D * P - cluster.b), 0.0) << trial;
    of_coulomb += open_of(cluster, P) < 1e-5 ? 1 : 0;
  }
  // Two were struck blow by blow.
  EXPECT_GE(of_coulomb, kTrials - 2);
}

TEST(ConeRounds, FindWhatManyBallsDo) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 4; ++trial) {
    const Cluster cluster = random_cluster(random, 16, 60, 0.5);  // 180 rows
    const linalg::SparseMatrix D = cluster.D.sparseView();
    const Vector P = solve_impact(D, cluster.b, std::ssize(cluster.slips), cluster.slips);
    EXPECT_LT(open_of(cluster, P), 1e-5) << trial;
  }
}

TEST(ConeProgram, KeepsConesOfImpulsesAndRates) {
  const Cluster row = wedged_row();
  const linalg::SparseMatrix D = row.D.sparseView();
  Vector P;
  ASSERT_TRUE(ConeProgram(D, row.places).solve(row.b, P));
  const Vector w = row.D * P - row.b;
  const double size = row.b.cwiseAbs().maxCoeff();
  for (const ImpactSlip& slip : row.slips) {
    EXPECT_LE(P.segment(slip.first, 2).norm(), slip.coefficient * P[slip.across] * (1 + 1e-9));
    // To the digits of the method.
    EXPECT_GE(w[slip.across], slip.coefficient * w.segment(slip.first, 2).norm() - 1e-8 * size);
  }
  EXPECT_NEAR(P.dot(w), 0, 1e-8 * std::abs(P.dot(row.b)));
}

TEST(ConeProgram, TellsWherePlacesAreDrivenAgainstEachOther) {
  // As in FrictionImpulses: one way to move, along which friction of 1.4 holds the rebound.
  const Eigen::Vector2d way(1.0, 1.5);
  const linalg::SparseMatrix D = Matrix(0.38 * way * way.transpose()).sparseView();
  const Vector stops = 0.4 * way, bounces = stops + Eigen::Vector2d(0.2, 0.0);
  ConeProgram program(D, {{{0, 1}, 1.4}});
  Vector P;
  EXPECT_FALSE(program.solve(bounces, P));
  ASSERT_TRUE(program.solve(stops, P));
  EXPECT_NEAR((D * P - stops).norm(), 0, 1e-8);
  EXPECT_LE(std::abs(P[1]), 1.4 * P[0] * (1 + 1e-9));
}

TEST(ConeProgram, LeavesOutWhatHasNoFriction) {
  // Two balls in a row that one strikes, without friction: as (I1).
  Matrix J(2, 2);
  J << 1, 0, -1, 1;
  const linalg::SparseMatrix D = Matrix(J * J.transpose()).sparseView();
  Vector P;
  ASSERT_TRUE(ConeProgram(D, {{{0}, 0.0}, {{1}, 0.0}}).solve(Eigen::Vector2d(1.0, 0.5), P));
  EXPECT_NEAR((P - Eigen::Vector2d(2.5, 1.5)).norm(), 0, 1e-7);  // D P = b within the cone
}

}  // namespace
}  // namespace buckens::stepping
