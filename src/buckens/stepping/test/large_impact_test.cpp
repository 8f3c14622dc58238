// SPDX-License-Identifier: Apache-2.0
// Impulses of many places at once: a lattice of balls in a box that all move, against the
// conditions of Coulomb and of one-sided rows, and against the same balls one row of places at a
// time.
#include "buckens/stepping/large_impact.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/stepping/friction_impulses.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

/// Solid balls of radius 1 and different masses in a cubic lattice on a floor, each touching its
/// neighbours.
struct BallLattice {
  linalg::SparseMatrix D;
  Vector b;
  std::vector<ConeRows> places;

  BallLattice(int side, double mu, double restitution) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> between(-1, 1);
    const auto number = [side](int i, int j, int k) { return (k * side + j) * side + i; };
    const int count = side * side * side;
    Vector mobility(6 * count), V(6 * count);
    for (int n = 0; n < count; ++n) {
      const double mass = 1.5 + between(random);
      mobility.segment<3>(6 * n).setConstant(1 / mass);
      mobility.segment<3>(6 * n + 3).setConstant(2.5 / mass);
      for (int c = 0; c < 6; ++c) V[6 * n + c] = between(random);
    }
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int first, int second, const Vector3d& normal) {
      ConeRows place;
      place.coefficient = mu;
      const Vector3d x = normal.unitOrthogonal();
      for (const Vector3d& u : {normal, x, Vector3d(normal.cross(x))}) {
        const int row = num_rows_++;
        place.rows.push_back(row);
        const auto set = [&](int n, const Vector3d& lever, double sign) {
          const Vector3d turn = lever.cross(u);
          for (int c = 0; c < 3; ++c) {
            entries.emplace_back(row, 6 * n + c, sign * u[c]);
            entries.emplace_back(row, 6 * n + 3 + c, sign * turn[c]);
          }
        };
        if (first >= 0) set(first, normal, -1);
        set(second, -normal, 1);
        if (mu == 0.0) break;
      }
      places.push_back(place);
    };
    for (int k = 0; k < side; ++k) {
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          const int own = number(i, j, k);
          if (i > 0) add(number(i - 1, j, k), own, Vector3d::UnitX());
          if (j > 0) add(number(i, j - 1, k), own, Vector3d::UnitY());
          add(k > 0 ? number(i, j, k - 1) : -1, own, Vector3d::UnitZ());
        }
      }
    }
    linalg::SparseMatrix J(num_rows_, 6 * count);
    J.setFromTriplets(entries.begin(), entries.end());
    D = J * mobility.asDiagonal() * linalg::SparseMatrix(J.transpose());
    b = -(J * V);
    for (const ConeRows& place : places) {
      double& asked = b[place.rows.front()];
      if (asked > 0) asked *= 1 + restitution;
    }
  }

 private:
  int num_rows_ = 0;
};

void expect_impulses(const BallLattice& balls, const Vector& P) {
  const Vector w = balls.D * P - balls.b;
  const double size = P.cwiseAbs().maxCoeff() + 1;
  for (const ConeRows& place : balls.places) {
    const double press = P[place.rows.front()], parts = w[place.rows.front()];
    EXPECT_GE(press, 0);
    EXPECT_GE(parts, -1e-9 * size);
    EXPECT_NEAR(press * parts, 0, 1e-9 * size * size);
    if (place.rows.size() == 1) continue;
    const Eigen::Vector2d rub(P[place.rows[1]], P[place.rows[2]]);
    const Eigen::Vector2d v(w[place.rows[1]], w[place.rows[2]]);
    const double most = place.coefficient * press;
    EXPECT_LE(rub.norm(), most * (1 + 1e-9) + 1e-10);
    // It stops, or slides on against the whole of the friction.
    EXPECT_NEAR((rub * v.norm() + most * v).norm(), 0,
                v.norm() > 1e-8 * size ? 1e-8 * size * size : HUGE_VAL);
  }
}

TEST(LargeImpact, SatisfiesCoulombAndOneSidedRows) {
  for (const double mu : {0.0, 0.1, 0.4}) {
    const BallLattice balls(4, mu, 0.5);  // 64 balls, 160 places
    expect_impulses(balls, solve_large_impact(balls.D, balls.b, balls.places));
  }
}

TEST(LargeImpact, IsWhatTheDenseOneIs) {
  const BallLattice balls(2, 0.3, 0.2);  // 8 balls, 16 places, whose impulses are unique
  const Vector P = solve_large_impact(balls.D, balls.b, balls.places);
  std::vector<Eigen::Index> order;
  std::vector<ImpactSlip> slips;
  for (const ConeRows& place : balls.places) order.push_back(place.rows[0]);
  for (std::size_t k = 0; k < balls.places.size(); ++k) {
    slips.push_back({static_cast<Eigen::Index>(k), std::ssize(order), 2, 0.3});
    order.push_back(balls.places[k].rows[1]);
    order.push_back(balls.places[k].rows[2]);
  }
  const Matrix D = Matrix(balls.D)(order, order);
  const linalg::SparseMatrix entries = D.sparseView();
  const Vector dense = solve_impact(entries, balls.b(order), std::ssize(balls.places), slips);
  // Rates are unique to what both leave open.
  EXPECT_NEAR((D * (dense - P(order))).cwiseAbs().maxCoeff(), 0, 1e-9);
}

/// Pendulums that strike with one way to move each, as in FrictionImpulses, and press the next one
/// a little: friction of 1.4 holds what restitution would part.
struct JammedRow {
  static constexpr Eigen::Index kCount = 80;
  linalg::SparseMatrix D;
  Vector stops, bounces;
  std::vector<ImpactSlip> slips;
  std::vector<ConeRows> places;

  JammedRow() {
    const Eigen::Vector2d way(1.0, 1.5);
    Matrix J = Matrix::Zero(2 * kCount, kCount);  // across, then along
    for (Eigen::Index k = 0; k < kCount; ++k) {
      J(k, k) = way[0];
      J(kCount + k, k) = way[1];
      if (k + 1 == kCount) continue;
      J(k, k + 1) = -0.1 * way[0];
      J(kCount + k, k + 1) = -0.1 * way[1];
    }
    D = Matrix(0.38 * J * J.transpose()).sparseView();
    stops = 0.4 * J * Vector::Ones(kCount);
    bounces = stops;
    bounces[0] += 0.2;
    for (Eigen::Index k = 0; k < kCount; ++k) {
      slips.push_back({k, kCount + k, 1, 1.4});
      places.push_back({{k, kCount + k}, 1.4});
    }
  }
};

TEST(LargeImpact, TellsWhereFrictionHoldsWhatRestitutionWouldPart) {
  const JammedRow row;
  EXPECT_THROW(solve_large_impact(row.D, row.bounces, row.places), StepFailure);
  std::vector<Eigen::Index> jammed;
  const Vector none = solve_impact(row.D, row.bounces, JammedRow::kCount, row.slips, &jammed);
  EXPECT_EQ(none.norm(), 0);
  EXPECT_EQ(std::ssize(jammed), 2 * JammedRow::kCount);  // all of them hang together
  jammed.clear();
  const Vector P = solve_impact(row.D, row.stops, JammedRow::kCount, row.slips, &jammed);
  EXPECT_TRUE(jammed.empty());
  // To what Newton's method leaves open.
  EXPECT_NEAR((row.D * P - row.stops).cwiseAbs().maxCoeff(), 0, 1e-9);
  EXPECT_LT(P.cwiseAbs().maxCoeff(), 10.0);
}

}  // namespace
}  // namespace buckens::stepping
