// SPDX-License-Identifier: Apache-2.0
// One linearisation of joints and loads for statics, stability and vibrations.
#include "buckens/analysis/statics/linearised_loads.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/analysis/test/static_models.h"
#include "buckens/analysis/vibration/rest_tangent.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {
namespace {

using test::at_marker;
using test::Mechanism;
using test::Vector3d;

/// Two beams at an angle, clamped to the ground and to each other, loaded and bent: the joints'
/// moments turn with the nodes that carry them.
struct Bent {
  std::unique_ptr<model::BuiltModel> built;
  model::State state;
  std::vector<int> rows;

  Bent() {
    Mechanism m;
    m.beam("first", 1.0, 4);
    m.beam("second", 0.7, 4, {1, 0, 0}, 0.8);
    m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("first/start"));
    m.joint<joints::FixedSpec>("corner", at_marker("first/end"), at_marker("second/start"));
    m.force("second/end", {30, -200, 150});
    built = m.build();
    state = model::placed_state(built->model);
    find_static_equilibrium(built->model, state);
    for (int k = 0; k < built->model.num_constraint_rows(); ++k) rows.push_back(k);
  }
};

Eigen::MatrixXd dense(const LinearisedLoads& loads, const model::State& state,
                      const model::Model& model) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(loads.size(), loads.size());
  const auto motions = dynamics::motions_of(model, state);
  for (const auto& block : loads.stiffness(motions, state.t, state.lambda)) {
    const BodyCoordinates& on = loads.bodies()[block.on];
    const BodyCoordinates& by = loads.bodies()[block.by];
    out.block(on.first, by.first, on.size(), by.size()) += block.stiffness;
  }
  return out;
}

TEST(LinearisedLoads, DoNotDependOnTheLengthOfTheModel) {
  Bent bent;
  model::Model& model = bent.built->model;
  const Eigen::MatrixXd expected = dense(LinearisedLoads(model), bent.state, model);
  ASSERT_GT(expected.norm(), 1.0);
  // The length is a measure for displacements. A node that was turned by 1e-5 of it, in metres
  // taken for radians, would go round by 0.1 rad on the longer model: 1e-3 wrong.
  model.length *= 1e4;
  const Eigen::MatrixXd longer = dense(LinearisedLoads(model), bent.state, model);
  // Rounding of forces over the smallest step: 1e-16 / 1e-5, a hundred forces added up.
  EXPECT_LT((longer - expected).norm(), 1e-8 * expected.norm());
  const Eigen::MatrixXd in_tangent =
      rest_tangent(model, bent.state, bent.rows, RestLoads::all).stiffness;
  const Eigen::MatrixXd symmetric = 0.5 * (expected + expected.transpose());
  const auto momenta = in_tangent.rows() - expected.rows();
  ASSERT_EQ(momenta, 6) << "three per deformed body";
  const Eigen::Index n = expected.rows() / 2;
  EXPECT_LT((in_tangent.topLeftCorner(n, n) - symmetric.topLeftCorner(n, n)).norm(),
            1e-8 * symmetric.norm());
}

TEST(LinearisedLoads, AreTheChangeOfTheLoads) {
  // Independent route: small rotations of the second frame by hand, twice halved and extrapolated.
  Bent bent;
  const model::Model& model = bent.built->model;
  const LinearisedLoads loads(model);
  const Eigen::MatrixXd stiffness = dense(loads, bent.state, model);
  const auto torque_on_second = [&](double angle) {
    auto motions = dynamics::motions_of(model, bent.state);
    Eigen::Quaterniond& q = motions[1].frame.X_WB.q;
    q = q * Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    dynamics::Forces forces;
    dynamics::Constraints constraints;
    dynamics::evaluate_constraints(model, motions, 0.0, constraints);
    dynamics::evaluate_forces(model, motions, 0.0, forces);
    dynamics::add_joint_forces(constraints, bent.state.lambda, forces);
    return Vector3d(forces.frame[1].head<3>());
  };
  const auto difference = [&](double h) {
    return Vector3d((torque_on_second(h) - torque_on_second(-h)) / (2 * h));
  };
  const Vector3d expected = (4.0 * difference(5e-4) - difference(1e-3)) / 3.0;
  const int first = loads.bodies()[1].first;
  const Vector3d found = -stiffness.block(first, first + 1, 3, 1);
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
}

}  // namespace
}  // namespace buckens::analysis
