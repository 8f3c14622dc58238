// SPDX-License-Identifier: Apache-2.0
// One step of a flexible body: the sieve against explicit multipliers, and how much it costs.
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/body/reduction.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/large_step.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

test::BeamConstants damped_beam() {
  test::BeamConstants beam;
  beam.EA = 1e4;
  beam.EIy = 60;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  return beam;
}

Vector some(Eigen::Index n, double seed) {
  Vector out(n);
  for (Eigen::Index k = 0; k < n; ++k) out[k] = std::sin(seed + 1.7 * static_cast<double>(k));
  return out;
}

/// Sieved nodal variables and rates in general position.
model::BodyState some_state(const body::FlexiblePart& part) {
  const Eigen::Index n = part.num_dofs();
  model::BodyState state;
  state.d = 0.01 * some(n, 0.3);
  state.d_dot = some(n, 1.1);
  state.d_ddot = 100 * some(n, 2.0);
  state.d_alg = 90 * some(n, 2.1);
  for (linalg::NodalVector* v : {&state.d, &state.d_dot, &state.d_ddot, &state.d_alg}) {
    part.sieve.apply(v->change());
  }
  return state;
}

/// Solution of [K̂ P; Pᵀ 0][x; Λ] = [f; 0], dense.
Vector bordered(const body::FlexiblePart& part, const Matrix& K_hat, const Vector& f) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& node : part.fe.nodes) positions.push_back(node.position);
  const Matrix P = part.fe.M * body::rigid_modes(positions, part.fe.dofs, part.fe.shape.com);
  const Eigen::Index n = K_hat.rows();
  Matrix A = Matrix::Zero(n + 6, n + 6);
  A.topLeftCorner(n, n) = K_hat;
  A.topRightCorner(n, 6) = P;
  A.bottomLeftCorner(6, n) = P.transpose();
  Vector b = Vector::Zero(n + 6);
  b.head(n) = f;
  return A.fullPivLu().solve(b).head(n);
}

/// Nodal variables at the end of a step with a nodal load and loads f along the rows of N.
Vector end_of_step(BodyStepOperator& op, const model::BodyState& before, const Vector& load,
                   const Vector& f) {
  LargeStep step(op);
  step.form_right_side(before, load, nullptr);
  op.solve_right_side(step.side());
  Vector y_free;
  step.take_solution(before, y_free, nullptr);
  model::BodyState after;
  step.complete(before, f, Vector::Zero(f.size()), after, nullptr);
  return after.d;
}

double energy_norm(const Matrix& K_hat, const Vector& x) { return std::sqrt(x.dot(K_hat * x)); }

/// 18 variables use the dense inverse, 30 the sparse factor.
class SmallAndLarge : public testing::TestWithParam<int> {};

TEST_P(SmallAndLarge, SieveEqualsMultiplier) {
  test::BeamConstants beam = damped_beam();
  beam.elements = GetParam();
  const model::Model model = test::spatial_beam_pendulum(beam);
  const body::FlexiblePart& part = *model.bodies[0].flexible;
  const model::BodyState state = some_state(part);
  const Vector load = 50 * some(part.num_dofs(), 4.0);
  for (const Method method : {Method::generalized_alpha, Method::newmark}) {
    const Scheme scheme(method, 1e-3, 0.9);
    BodyStepOperator op(part, scheme);
    const auto history = scheme.history<Vector>(state.d_dot, state.d_ddot, state.d_alg);
    const Vector f = 30 * some(op.compliance().rows(), 5.0);
    const Vector fast = end_of_step(op, state, load, f);

    // The same step by its increment: K̂ Δ + PΛ = c (F − M ẍ₀ − C ẋ₀ − K d).
    const Matrix K_hat = op.K_hat();
    const Vector interface = op.loads_along_rows() * f;
    const Vector rest = load + interface - part.fe.M * history.acceleration -
                        part.C * history.mean_velocity - part.fe.K * state.d.whole();
    const Vector slow = state.d.whole() + bordered(part, K_hat, scheme.force * rest);
    EXPECT_LE(energy_norm(K_hat, fast - slow), 1e-12 * energy_norm(K_hat, slow))
        << to_string(method);
    EXPECT_LE(part.sieve.rigid_part(fast).norm(), 1e-15 * fast.norm() * 10);
  }
}

INSTANTIATE_TEST_SUITE_P(BodyStepOperator, SmallAndLarge, testing::Values(2, 4));

TEST(BodyStepOperator, OneFactorServesBodiesWithTheSameMatrices) {
  test::BeamConstants beam = damped_beam();
  const model::Model first = test::spatial_beam_pendulum(beam);
  const model::Model same = test::spatial_beam_pendulum(beam);
  beam.EIz *= 2.0;
  const model::Model other = test::spatial_beam_pendulum(beam);
  const auto& part = *first.bodies[0].flexible;
  const Scheme scheme(Method::generalized_alpha, 1e-3, 0.9);
  const BodyStepOperator op(part, scheme);
  EXPECT_TRUE(op.fits(*same.bodies[0].flexible));
  EXPECT_FALSE(op.fits(*other.bodies[0].flexible));
  const BodyStepOperator twin(*same.bodies[0].flexible, scheme, {&op});
  EXPECT_EQ(op.factorisations(), 1);
  EXPECT_EQ(twin.factorisations(), 0);
  EXPECT_EQ((twin.compliance() - op.compliance()).norm(), 0.0);
  // Another step length is another matrix.
  const Scheme longer(Method::generalized_alpha, 2e-3, 0.9);
  EXPECT_EQ(BodyStepOperator(part, longer, {&op}).factorisations(), 1);
}

TEST(BodyStepOperator, ReducedBodiesDivideAndAnswerAsTheFullOne) {
  const model::Model model = test::spatial_beam_pendulum(damped_beam());
  const body::FlexiblePart& full = *model.bodies[0].flexible;
  const body::ReducedBasis basis = body::free_free_basis("beam", full, 1000, true, 1.0);
  const auto part = body::reduce("beam", full, basis);
  const model::BodyState state = some_state(full);
  model::BodyState reduced_state;
  reduced_state.d = part->coordinates(state.d);
  reduced_state.d_dot = part->coordinates(state.d_dot);
  reduced_state.d_ddot = part->coordinates(state.d_ddot);
  reduced_state.d_alg = part->coordinates(state.d_alg);
  const Vector load = 50 * some(full.num_dofs(), 4.0);
  const Scheme scheme(Method::generalized_alpha, 1e-3, 0.9);
  BodyStepOperator op(*part, scheme);
  BodyStepOperator full_op(full, scheme);
  EXPECT_TRUE(op.is_diagonal());
  EXPECT_FALSE(full_op.is_diagonal());
  EXPECT_EQ(op.factorisations(), 0);
  EXPECT_EQ(op.factor_entries(), 0);
  // Rounding of modes: 1e-16 (ω_max/ω_1)².
  EXPECT_LE((op.compliance() - full_op.compliance()).norm(), 1e-9 * full_op.compliance().norm());
  const Vector f = 30 * some(op.compliance().rows(), 5.0);
  const Vector x = end_of_step(op, reduced_state, basis.Z.transpose() * load, f);
  const Vector expected = end_of_step(full_op, state, load, f);
  const Matrix K_hat = full_op.K_hat();
  EXPECT_LE(energy_norm(K_hat, part->nodal(x) - expected), 1e-9 * energy_norm(K_hat, expected));
}

/// Of three methods: equations at the end of the step, within it, and beyond it.
class LargeStepBy : public testing::TestWithParam<Method> {};

TEST_P(LargeStepBy, SecondSolveForTheChangeOfALoadGivesTheStepWithTheNewLoad) {
  const model::Model model = test::spatial_beam_pendulum(damped_beam());
  const body::FlexiblePart& part = *model.bodies[0].flexible;
  const Scheme scheme(GetParam(), 1e-3, GetParam() == Method::wilson ? 1.4 : 0.9);
  BodyStepOperator op(part, scheme);
  const model::BodyState before = some_state(part);
  const Vector first = 50 * some(part.num_dofs(), 4.0);
  const Vector second = 40 * some(part.num_dofs(), 7.0);
  const Vector f = 30 * some(op.compliance().rows(), 5.0);
  const Vector e = Vector::Zero(f.size());
  LargeStep twice(op), once(op);
  Vector y_twice, y_once;
  model::BodyState after, expected;
  twice.form_right_side(before, first, nullptr);
  op.solve_right_side(twice.side());
  twice.take_solution(before, y_twice, nullptr);
  twice.form_right_side_of_change(first, second, nullptr);
  op.solve_right_side(twice.side());
  twice.take_solution(before, y_twice, nullptr);
  twice.complete(before, f, e, after, nullptr);
  once.form_right_side(before, second, nullptr);
  op.solve_right_side(once.side());
  once.take_solution(before, y_once, nullptr);
  once.complete(before, f, e, expected, nullptr);
  EXPECT_LE((y_twice - y_once).norm(), 1e-13 * y_once.norm());
  EXPECT_LE((after.d.whole() - expected.d.whole()).norm(), 1e-13 * expected.d.norm());
  // Rates and accelerations are increments over h and h²: their rounding is that of d so divided.
  EXPECT_LE((after.d_dot.whole() - expected.d_dot.whole()).norm(), 1e-12 * expected.d_dot.norm());
  EXPECT_LE((after.d_ddot.whole() - expected.d_ddot.whole()).norm(),
            1e-11 * expected.d_ddot.norm());
  // The motion without loads along N has the values that its rows say.
  once.complete(before, Vector::Zero(f.size()), e, expected, nullptr);
  EXPECT_LE((op.row_values(expected.d.whole()) - y_once).norm(), 1e-12 * y_once.norm());
}

INSTANTIATE_TEST_SUITE_P(BodyStepOperator, LargeStepBy,
                         testing::Values(Method::generalized_alpha, Method::newmark,
                                         Method::wilson));

TEST(BodyStepOperator, CorrectionsMoveStrainButNotInertia) {
  const model::Model model = test::spatial_beam_pendulum(damped_beam());
  const body::FlexiblePart& part = *model.bodies[0].flexible;
  const Scheme scheme(Method::generalized_alpha, 1e-3, 0.9);
  const BodyStepOperator op(part, scheme);
  Vector e = some(op.compliance().rows(), 1.0);
  e.tail<6>().setZero();  // corrections act along interface rows only, not along patterns
  const Matrix K_hat = op.K_hat();
  const Vector eta = bordered(part, K_hat, op.loads_along_rows() * e);
  Vector x = Vector::Zero(part.num_dofs());
  op.add_correction(e, 0, x);
  EXPECT_LE(energy_norm(K_hat, x - eta), 1e-12 * energy_norm(K_hat, eta));
  op.add_correction_answer(e, 0, x);
  // K̂ Δ + PΛ = −k K η, x = Δ + η.
  const Vector expected = eta + bordered(part, K_hat, -scheme.stiffness * (part.fe.K * eta));
  EXPECT_LE(energy_norm(K_hat, x - expected), 1e-12 * energy_norm(K_hat, eta));
}

TEST(Stepper, OneFactorisationAndOneLargeSolvePerStepWithoutCoupling) {
  const model::Model model =
      test::planar_beam_pendulum(test::BeamConstants{}, body::CouplingLevel::none);
  for (const Method method : {Method::generalized_alpha, Method::newmark}) {
    StepSettings settings;
    settings.method = method;
    Stepper stepper(model, settings, {0, 1});
    const long setup = stepper.counts(0).setup_solves;
    model::State state = model::placed_state(model);
    for (int k = 0; k < 50; ++k) EXPECT_EQ(stepper.step(state).large_solve_rounds, 1);
    const SolveCounts counts = stepper.counts(0);
    EXPECT_EQ(counts.factorisations, 1);
    EXPECT_EQ(counts.solves, 50);
    EXPECT_EQ(counts.setup_solves, setup);  // nothing more while stepping
  }
}

TEST(Stepper, FullCouplingTakesOneOrTwoSolvesPerStep) {
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  StepSettings settings;
  settings.step = 1e-4;
  Stepper stepper(model, settings, {0, 1});
  model::State state = model::placed_state(model);
  long rounds = 0;
  for (int k = 0; k < 200; ++k) rounds += stepper.step(state).large_solve_rounds;
  const SolveCounts counts = stepper.counts(0);
  EXPECT_EQ(counts.factorisations, 1);
  // A round may leave the load unchanged and change only moments of the frame.
  EXPECT_LE(counts.solves, rounds);
  EXPECT_GE(counts.solves, 200);
  EXPECT_LE(counts.solves, 400);
  // Two columns per interface row (force, correction) and one for each of the six patterns.
  EXPECT_EQ(counts.setup_solves, 2 * model.bodies[0].num_interface_rows() + 6);
}

TEST(Stepper, RigidBodiesCostNoLargeSolves) {
  const model::Model model = test::rigid_double_pendulum(true);
  Stepper stepper(model, StepSettings{}, {0, 1, 2, 3});
  model::State state = model::placed_state(model);
  const StepReport report = stepper.step(state);
  EXPECT_GE(report.newton_iterations, 1);
  EXPECT_LE(report.position_residual, 1e-12);
  EXPECT_LE(report.velocity_residual, 1e-9);
  EXPECT_EQ(stepper.counts(0).factorisations, 0);
  EXPECT_EQ(stepper.counts(1).solves, 0);
}

}  // namespace
}  // namespace buckens::stepping
