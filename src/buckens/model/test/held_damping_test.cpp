// SPDX-License-Identifier: Apache-2.0
// Mass damping of held bodies: its effect on deformations, and none on rigid motion.
#include "buckens/model/build/held_damping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"

namespace buckens::model {
namespace {

using linalg::Matrix;
using linalg::Vector;
using test::Described;
using testing::HasSubstr;

fem::DampingSpec ratio(double value, std::vector<double> at) {
  fem::DampingSpec out;
  out.ratio = value;
  out.at = std::move(at);
  return out;
}

Described clamped_beam(int elements = 4) {
  Described m;
  m.beam("beam", {0, 0, 0}, {1, 0, 0}, elements).damping = ratio(0.02, {20, 200});
  m.joint<joints::FixedSpec>("clamp", "ground", "beam/start");
  return m;
}

/// Positive eigenvalues but for rounding.
void expect_semidefinite(const body::FlexiblePart& part) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen{Matrix(part.C.whole())};
  EXPECT_GT(eigen.eigenvalues()[0], -1e-12 * eigen.eigenvalues().tail<1>()[0]);
}

/// ‖CΦ‖ outside the span of P, relative.
double outside_of_span(const body::FlexiblePart& part) {
  const Matrix image = part.C * part.sieve.Phi();
  const Matrix& P = part.sieve.P();
  const Matrix left = image - P * P.colPivHouseholderQr().solve(image);
  return left.norm() / Matrix(part.C.whole()).norm();
}

TEST(HeldDamping, DragsOnTheMotionFromTheClamp) {
  Described m = clamped_beam();
  const auto built = m.build();
  const body::FlexiblePart& part = *built->model.bodies[0].flexible;
  const double alpha = m.d.bodies[0].damping->alpha(), beta = m.d.bodies[0].damping->beta();
  // Any deformation that leaves the clamp still, seen from the body frame, costs what it costs seen
  // from the clamp: α uᵀMu + β uᵀKu.
  std::srand(7);
  Vector u = Vector::Random(part.num_dofs());
  for (const int dof : part.fe.dofs.node_dofs[0]) u[dof] = 0.0;
  Vector d = u;
  part.sieve.apply(d);
  const double expected = alpha * u.dot(part.fe.M * u) + beta * u.dot(part.fe.K * u);
  // Rounding of rotations about the axis, whose inertia is 1e-4 of the others.
  EXPECT_NEAR(d.dot(part.C * d), expected, 1e-9 * expected);
  expect_semidefinite(part);
  EXPECT_LT(outside_of_span(part), 1e-12);
}

TEST(HeldDamping, IsMassDampingOfTheFrameWhereNothingHolds) {
  Described m;
  m.beam("beam", {0, 0, 0}, {1, 0, 0}, 4).damping = ratio(0.02, {20, 200});
  const auto built = m.build();
  const body::FlexiblePart& part = *built->model.bodies[0].flexible;
  const fem::DampingSpec& spec = *m.d.bodies[0].damping;
  const linalg::SparseMatrix expected =
      spec.alpha() * part.fe.M.whole() + spec.beta() * part.fe.K.whole();
  EXPECT_LT((part.C.whole() - expected).norm(), 1e-14 * expected.norm());
}

/// What mass damping takes from a beam of four elements that bends as x².
double mass_share(const Described& m, std::size_t b) {
  const auto built = m.build();
  const body::FlexiblePart& part = *built->model.bodies[b].flexible;
  Vector d = Vector::Zero(part.num_dofs());
  for (std::size_t k = 0; k < 5; ++k) {
    const double s = static_cast<double>(k) / 4;
    d[part.fe.dofs.node_dofs[k][1]] = s * s;
    d[part.fe.dofs.node_dofs[k][5]] = 2 * s;
  }
  part.sieve.apply(d);
  expect_semidefinite(part);
  EXPECT_LT(outside_of_span(part), 1e-12);
  return d.dot(part.C * d) - m.d.bodies[b].damping->beta() * d.dot(part.fe.K * d);
}

TEST(HeldDamping, LiesBetweenFreeAndHeldWithAPartnerThatMoves) {
  // A clamp on a rigid body: a light one hardly holds; a heavy one acts as a wall.
  const auto with_hub = [](double mass) {
    Described m;
    m.rigid("hub", mass, {0, 0, 0}, {mass, mass, mass});
    m.beam("beam", {0, 0, 0}, {1, 0, 0}, 4).damping = ratio(0.02, {20, 200});
    m.joint<joints::FixedSpec>("clamp", "hub", "beam/start");
    return mass_share(m, 1);
  };
  Described free;
  free.beam("beam", {0, 0, 0}, {1, 0, 0}, 4).damping = ratio(0.02, {20, 200});
  const double light = with_hub(1e-6), middle = with_hub(1.0), heavy = with_hub(1e9);
  EXPECT_LT(1.1 * light, middle);
  EXPECT_LT(1.5 * middle, heavy);
  EXPECT_NEAR(light, mass_share(free, 0), 1e-3 * light);
  EXPECT_NEAR(heavy, mass_share(clamped_beam(), 0), 1e-6 * heavy);  // the hub still moves by 1e-9
}

TEST(HeldDamping, StiffnessAloneAtOneFrequency) {
  Described m = clamped_beam();
  m.d.bodies[0].damping = ratio(0.02, {20});
  const auto built = m.build();
  const body::FlexiblePart& part = *built->model.bodies[0].flexible;
  const double beta = 2 * 0.02 / (2 * M_PI * 20);
  const linalg::SparseMatrix expected = beta * part.fe.K.whole();
  EXPECT_LT((part.C.whole() - expected).norm(), 1e-14 * expected.norm());
}

TEST(HeldDamping, SurvivesReduction) {
  Described m = clamped_beam();
  m.d.bodies[0].reduction.craig_bampton.emplace();
  m.d.bodies[0].reduction.craig_bampton->modes = 18;  // all
  const auto reduced = m.build();
  const auto full = clamped_beam().build();
  const body::FlexiblePart& small = *reduced->model.bodies[0].flexible;
  const body::FlexiblePart& large = *full->model.bodies[0].flexible;
  ASSERT_TRUE(small.is_reduced());
  const Vector q = Vector::LinSpaced(small.num_dofs(), -1, 1);
  const Vector d = small.nodal(q);
  const double expected = d.dot(large.C * d);
  EXPECT_NEAR(q.dot(small.C * q), expected, 1e-9 * std::abs(expected));
}

TEST(HeldDamping, IsRefusedWithSeveralFrames) {
  Described m = clamped_beam();
  m.d.bodies[0].frames = 2;
  EXPECT_THAT([&] { m.build(); },
              testing::ThrowsMessage<ModelError>(testing::AllOf(
                  HasSubstr("\"beam\""), HasSubstr("several frames"), HasSubstr("at: [f]"))));
}

}  // namespace
}  // namespace buckens::model
