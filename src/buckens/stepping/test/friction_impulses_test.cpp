// SPDX-License-Identifier: Apache-2.0
// Impulses with friction: conditions of Coulomb and of one-sided rows, and closed forms.
#include "buckens/stepping/friction_impulses.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

/// Of a matrix that is written down whole.
Vector solve_impact(const Matrix& D, const Vector& b, Eigen::Index num_across,
                    const std::vector<ImpactSlip>& slips,
                    std::vector<Eigen::Index>* jammed = nullptr) {
  const linalg::SparseMatrix entries = D.sparseView();
  return stepping::solve_impact(entries, b, num_across, slips, jammed);
}

TEST(FrictionImpulses, OfASphereOnAPlaneAreTheClosedForm) {
  // Mass 2, solid: the slip answers with 7/2 of the inverse mass.
  const Matrix D = Eigen::Vector3d(0.5, 1.75, 1.75).asDiagonal();
  const Eigen::Vector2d slip(0.6, -0.8);
  Vector b(3);
  b << 4.0, -slip;  // it comes with 4/(1 + e)
  for (const double mu : {0.02, 0.05, 0.1, 1.0}) {
    const Vector P = solve_impact(D, b, 1, {{0, 1, 2, mu}});
    EXPECT_NEAR(P[0], 8.0, 1e-13);
    const double size = std::min(mu * 8.0, 2.0 / 7.0 * 2.0);
    EXPECT_NEAR((P.tail<2>() + size * slip).norm(), 0, 1e-13) << mu;
  }
}

TEST(FrictionImpulses, LeaveOutDirectionsThatGuidesHold) {
  // Without slip and without an answer, alone and beside a direction that slips.
  const Matrix guided = Eigen::Vector2d(0.5, 0.0).asDiagonal();
  const Vector none = solve_impact(guided, Eigen::Vector2d(4.0, 0.0), 1, {{0, 1, 1, 0.3}});
  EXPECT_NEAR((none - Eigen::Vector2d(8.0, 0.0)).norm(), 0, 1e-13);
  const Matrix along_rail = Eigen::Vector3d(0.5, 1.75, 1e-17).asDiagonal();
  const Vector P =
      solve_impact(along_rail, Eigen::Vector3d(4.0, -10.0, 1e-18), 1, {{0, 1, 2, 0.1}});
  EXPECT_NEAR((P - Eigen::Vector3d(8.0, -0.8, 0.0)).norm(), 0, 1e-13);
}

TEST(FrictionImpulses, TellWhereFrictionHoldsWhatRestitutionWouldPart) {
  // A pendulum that strikes with one way to move: both rows are that way, by 1 and 1.5, and
  // friction of 1.4 stops it before it could part.
  const Eigen::Vector2d way(1.0, 1.5);
  const Matrix D = 0.38 * way * way.transpose();
  const Eigen::Vector2d stops = 0.4 * way;
  const Eigen::Vector2d bounces = stops + Eigen::Vector2d(0.2, 0.0);
  EXPECT_THROW(solve_impact(D, bounces, 1, {{0, 1, 1, 1.4}}), StepFailure);
  std::vector<Eigen::Index> jammed;
  EXPECT_EQ(solve_impact(D, bounces, 1, {{0, 1, 1, 1.4}}, &jammed).norm(), 0);
  EXPECT_EQ(jammed, (std::vector<Eigen::Index>{0, 1}));
  jammed.clear();
  const Vector P = solve_impact(D, stops, 1, {{0, 1, 1, 1.4}}, &jammed);
  EXPECT_TRUE(jammed.empty());
  EXPECT_NEAR((D * P - stops).norm(), 0, 1e-13);
  EXPECT_LE(std::abs(P[1]), 1.4 * P[0]);
  EXPECT_LT(P.norm(), 10.0);
  // With less friction it parts while it slides back: 0.38 (1 - 0.3 * 1.5) P = 0.6.
  const Vector slides = solve_impact(D, bounces, 1, {{0, 1, 1, 0.3}});
  EXPECT_NEAR(slides[0], 0.6 / (0.38 * 0.55), 1e-12);
  EXPECT_NEAR(slides[1], -0.3 * slides[0], 1e-12);
}

TEST(FrictionImpulses, SatisfyCoulombAndOneSidedRows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    // Three places on bodies with eight coordinates.
    const Eigen::Index places = 3;
    Matrix J(9, 8);
    for (double& value : J.reshaped()) value = between(random);
    const Matrix D = J * J.transpose() + 0.02 * Matrix::Identity(9, 9);
    Vector b(9);
    for (double& value : b) value = between(random);
    std::vector<ImpactSlip> slips;
    for (Eigen::Index k = 0; k < places; ++k) slips.push_back({k, places + 2 * k, 2, 0.2});
    const Vector P = solve_impact(D, b, places, slips);
    const Vector w = D * P - b;
    const double size = P.cwiseAbs().maxCoeff() + 1;
    for (const ImpactSlip& slip : slips) {
      const double press = P[slip.across];
      EXPECT_GE(press, 0);
      EXPECT_GE(w[slip.across], -1e-10 * size);
      EXPECT_NEAR(press * w[slip.across], 0, 1e-10 * size * size);
      const Vector rub = P.segment(slip.first, 2);
      const Vector v = w.segment(slip.first, 2);
      EXPECT_LE(rub.norm(), slip.coefficient * press * (1 + 1e-12) + 1e-15);
      // It stops, or slides on against the whole of the friction.
      if (v.norm() > 1e-9 * size) {
        EXPECT_NEAR((rub * v.norm() + slip.coefficient * press * v).norm(), 0, 1e-9 * size * size);
      }
    }
  }
}

/// A box that strikes a plane with its lowest corners.
struct FallingBox {
  Matrix D;
  Vector b;
  std::vector<ImpactSlip> slips;
};

FallingBox falling_box(std::mt19937& random, Eigen::Index corners, double mu) {
  std::uniform_real_distribution<double> between(-1, 1);
  Eigen::Vector3d half;
  for (double& side : half) side = 0.1 + 0.08 * between(random);
  const Eigen::Vector3d square = half.cwiseProduct(half);
  const Eigen::Vector3d J = (square.sum() * Eigen::Vector3d::Ones() - square) / 3.0;
  Eigen::Quaterniond q(1, 0, 0, 0);
  if (corners == 1) q = {between(random), between(random), between(random), between(random)};
  if (corners == 2) q = {1, 0.3 * between(random), 0, 0};
  const Eigen::Matrix3d R = q.normalized().toRotationMatrix();
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d sign((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
    places.push_back(R * half.cwiseProduct(sign));
  }
  std::sort(places.begin(), places.end(),
            [](const auto& a, const auto& c) { return a.z() < c.z(); });
  Matrix A(3 * corners, 6);
  FallingBox out;
  for (Eigen::Index k = 0; k < corners; ++k) {
    const Eigen::Vector3d& x = places[static_cast<std::size_t>(k)];
    const auto set = [&](Eigen::Index row, const Eigen::Vector3d& d) {
      A.row(row) << d.transpose(), x.cross(d).transpose();
    };
    set(k, Eigen::Vector3d::UnitZ());
    set(corners + 2 * k, Eigen::Vector3d::UnitX());
    set(corners + 2 * k + 1, Eigen::Vector3d::UnitY());
    out.slips.push_back({k, corners + 2 * k, 2, mu});
  }
  Matrix M = Matrix::Identity(6, 6);  // inverse
  M.bottomRightCorner<3, 3>() = R * J.cwiseInverse().asDiagonal() * R.transpose();
  Vector V(6);
  V << 2 * between(random), 2 * between(random), -std::abs(between(random)), 5 * between(random),
      5 * between(random), 5 * between(random);
  out.D = A * M * A.transpose();
  out.b = -A * V;
  return out;
}

TEST(FrictionImpulses, OfBoxesOnOneToFourCornersAreFound) {
  std::mt19937 random(3);
  int of_coulomb = 0, all = 0;
  for (const Eigen::Index corners : {1, 2, 4}) {
    for (int trial = 0; trial < 60; ++trial) {
      const double mu = 0.3 * (1 + trial % 5);
      const FallingBox box = falling_box(random, corners, mu);
      const Vector P = solve_impact(box.D, box.b, corners, box.slips);
      const Vector w = box.D * P - box.b;
      const double speed = box.b.cwiseAbs().maxCoeff();
      double open = 0;  // of Coulomb's law
      for (const ImpactSlip& slip : box.slips) {
        const double press = P[slip.across];
        const Vector rub = P.segment(slip.first, 2);
        const Vector v = w.segment(slip.first, 2);
        EXPECT_GE(press, 0);
        EXPECT_GE(w[slip.across], -1e-8 * speed);
        EXPECT_LE(rub.norm(), mu * press * (1 + 1e-9) + 1e-12);
        open = std::max({open, std::min(std::abs(w[slip.across]) / speed, press),
                         (rub * v.norm() + mu * press * v).norm() / speed});
      }
      // None of them takes energy from nowhere.
      EXPECT_LE(P.dot(0.5 * box.D * P - box.b), 1e-9 * P.dot(box.D * P));
      if (corners == 1) {
        EXPECT_LE(open, 1e-8) << mu;
      }
      of_coulomb += open < 1e-4 ? 1 : 0;
      ++all;
    }
  }
  // The others were struck blow by blow.
  EXPECT_GE(of_coulomb, 0.95 * all);
}

TEST(FrictionImpulses, NameFrictionThatJams) {
  // A guide lets the place move along one line only, within its cone: whatever presses is rubbed
  // off.
  const Eigen::Vector2d line = Eigen::Vector2d(0.3, 1.0).normalized();
  const Matrix D = line * line.transpose();
  try {
    solve_impact(D, Eigen::Vector2d(0.1, -1.0), 1, {{0, 1, 1, 1.0}});
    FAIL();
  } catch (const StepFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("jams"), std::string::npos);
  }
}

TEST(FrictionImpulses, OfBodiesApartAreThoseOfEach) {
  std::mt19937 random(5);
  const FallingBox one = falling_box(random, 2, 0.6), other = falling_box(random, 1, 0.9);
  // Rows across of both, then along of both.
  const std::vector<Eigen::Index> first = {0, 1, 3, 4, 5, 6}, second = {2, 7, 8};
  Matrix D = Matrix::Zero(9, 9);
  Vector b(9);
  D(first, first) = one.D;
  D(second, second) = other.D;
  b(first) = one.b;
  b(second) = other.b;
  const Vector P = solve_impact(D, b, 3, {{0, 3, 2, 0.6}, {1, 5, 2, 0.6}, {2, 7, 2, 0.9}});
  EXPECT_EQ((P(first) - solve_impact(one.D, one.b, 2, one.slips)).norm(), 0);
  EXPECT_EQ((P(second) - solve_impact(other.D, other.b, 1, other.slips)).norm(), 0);
}

TEST(FrictionImpulses, AreSharedWhereRowsHoldTheSame) {
  // Two corners of a sliding block that press and rub on one line: their slips are the same.
  Matrix J(4, 3);
  const double w = 0.2, h = 0.1;
  J << 0, 1, w, 0, 1, -w, 1, 0, h, 1, 0, h;
  const Matrix D = J * Eigen::Vector3d(0.5, 0.5, 20.0).asDiagonal() * J.transpose();
  Vector b(4);
  b << 1, 1, -0.1, -0.1;
  const Vector P = solve_impact(D, b, 2, {{0, 2, 1, 0.9}, {1, 3, 1, 0.9}});
  const Vector after = D * P - b;
  EXPECT_NEAR(after.norm(), 0, 1e-11);  // all of them stop
  EXPECT_NEAR(P[0] + P[1], 2, 1e-11);
  EXPECT_GT(P[0], 0);
  EXPECT_GT(P[1], 0);
}

}  // namespace
}  // namespace buckens::stepping
