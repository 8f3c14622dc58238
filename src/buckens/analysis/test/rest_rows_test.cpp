// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/rest_rows.h"

#include <gtest/gtest.h>

#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/analysis/test/static_models.h"
#include "buckens/model/build/paired_model.h"

namespace buckens::analysis::test {
namespace {

using linalg::Vector;

/// A rod on a rough plane: a ball at either end.
std::unique_ptr<model::BuiltModel> rod_on_plane() {
  Mechanism m({0, 0, -9.81});
  m.rigid_rod("rod", 1.0, 2.0, {0, 0, 0.1}, 0.3);
  for (const char* end : {"rod/s", "rod/e"}) {
    auto& contact = m.load<loads::ContactSpec>(std::string("under ") + end);
    contact.between = {at_marker("ground"), at_marker(end)};
    contact.shapes[0].kind = loads::PlaneShape{};
    loads::SphereShape sphere;
    sphere.radius = 0.1;
    contact.shapes[1].kind = sphere;
    contact.coefficient = 0.5;
  }
  return m.build();
}

/// The same with everything that statics make of it.
struct Resting {
  std::unique_ptr<model::BuiltModel> built = rod_on_plane();
  model::State state = model::placed_state(built->model);
  RestRows rest{built->model, model::RestFriction::frozen, state};
  Compliances compliances{built->model};
  StaticPoint point = static_point(built->model, rest, state);
  StaticSystem system{built->model, rest, compliances.of_body, {}, 0.0, 20.0};
};

TEST(RestRows, FrozenFrictionHoldsAlongWhatTouches) {
  Resting model;
  ASSERT_EQ(model.rest.size(), 6u);
  for (const loads::RowStand& stand : model.point.rest) EXPECT_EQ(stand.regime, 1);
  const RestRows free(model.built->model, model::RestFriction::free, model.state);
  EXPECT_EQ(free.size(), 2u);
  EXPECT_TRUE(free.leaves_friction());
  EXPECT_FALSE(model.rest.leaves_friction());
  // Higher up nothing touches, and nothing holds along.
  model.state.bodies[0].frame.X_WB.p.z() += 0.1;
  for (const loads::RowStand& stand :
       static_point(model.built->model, model.rest, model.state).rest) {
    EXPECT_EQ(stand.regime, 0);
  }
}

TEST(RestRows, DerivativesOfTheSystemAreDifferences) {
  Resting model;
  model.point.rest[0].force = 7.0;
  model.point.rest[1].force = -2.0;
  model.point.rest[3].force = 5.0;
  StaticSystem& system = model.system;
  system.linearise(model.point, system.balance(model.point));
  const linalg::SparseMatrix A = system.tangent(0.0, model.point.rest);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < system.size(); ++k) {
    const auto residual_after = [&](double step) {
      const StaticPoint moved =
          system.moved(model.point, Vector(step * Vector::Unit(system.size(), k)));
      return system.residual(moved, system.balance(moved));
    };
    const Vector difference = (residual_after(kStep) - residual_after(-kStep)) / (2 * kStep);
    for (int row = 0; row < system.size(); ++row) {
      // A closed row gives by 1e-10 to its own force; rows along a surface have no position.
      const bool is_rate = row >= 6 && model.rest[static_cast<std::size_t>(row - 6)].kind !=
                                           RestRow::Kind::one_sided;
      if (is_rate) continue;
      // Differences of both: rounding 1e-16/1e-5, curvature 1e-10.
      EXPECT_NEAR(A.coeff(row, k), difference[row], 1e-9) << row << " by " << k;
    }
  }
}

/// Three balls in a row over a rough plane, a metre apart: a group.
std::unique_ptr<model::BuiltModel> balls_over_plane() {
  Mechanism m({0, 0, -9.81});
  auto& group = m.load<loads::ContactsSpec>("heap");
  loads::ContactMemberSpec floor;
  floor.on = at_marker("ground");
  floor.shape.kind = loads::PlaneShape{};
  group.among.push_back(floor);
  for (int k = 0; k < 3; ++k) {
    const std::string name = "b" + std::to_string(k);
    m.rigid_rod(name, 0.1, 2.0, {1.0 * k, 0, 0.3}, 0.3);
    loads::ContactMemberSpec ball;
    ball.on = at_marker(name + "/s");
    loads::SphereShape sphere;
    sphere.radius = 0.1;
    ball.shape.kind = sphere;
    group.among.push_back(ball);
  }
  group.coefficient = 0.5;
  return m.build();
}

TEST(RestRows, PairsComeAndGoWithTheirStands) {
  const auto built = balls_over_plane();
  model::PairedModel paired(*built);
  const model::Model& model = paired.built().model;
  const model::State state = model::placed_state(model);
  RestRows rest(model, model::RestFriction::frozen, state, paired.pairs());
  EXPECT_EQ(rest.size(), 0u);
  const StaticPoint start = static_point(model, rest, state);
  const auto way_of = [&](std::size_t body, double z) {
    StaticPoint end = start;
    end.poses[body].p.z() += z;
    return motions_towards(model, start, end);
  };
  // One ball that falls by 0.15 m may touch the plane 0.2 m below it; 0.01 m is not far enough.
  EXPECT_FALSE(rest.follow_pairs(way_of(2, -0.01), true));
  ASSERT_TRUE(rest.follow_pairs(way_of(2, -0.15), true));
  ASSERT_EQ(rest.size(), 3u);  // across, and along twice
  EXPECT_EQ(rest.name(0), "heap\" between \"ground\" and \"b2");
  const RestOrder one = rest.order();
  const RestStands stands = {{1, 7.0}, {1, 2.0}, {1, -3.0}};
  ASSERT_TRUE(rest.follow_pairs(way_of(0, -0.15), true));
  ASSERT_EQ(rest.size(), 6u);
  EXPECT_EQ(rest.places_in(one), (std::vector<int>{-1, -1, -1, 0, 1, 2}));
  const RestStands both = rest.carried(one, stands);
  EXPECT_EQ(both[0].regime, 0);
  EXPECT_EQ(both[3].force, 7.0);
  EXPECT_EQ(both[5].force, -3.0);
  // Without keeping them, those that are far from the way go.
  const RestOrder two = rest.order();
  ASSERT_TRUE(rest.follow_pairs(way_of(0, -0.15), false));
  EXPECT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest.name(0), "heap\" between \"ground\" and \"b0");
  EXPECT_EQ(rest.carried(two, both)[0].force, both[0].force);
  ASSERT_TRUE(rest.follow_pairs(way_of(0, 0.0), false));
  EXPECT_EQ(rest.size(), 0u);
}

TEST(RestPivots, RowsThatNeverSettleAreNamed) {
  Resting model;
  model.system.linearise(model.point, model.system.balance(model.point));
  const StaticBalance balance = model.system.balance(model.point);
  // Whoever is closed would pull, and whoever is open would sink in.
  Vector step = Vector::Zero(model.system.size());
  step[5] = -1.0;
  for (Eigen::Index k = 6; k < step.size(); ++k) step[k] = -1.0;
  RestPivots pivots(model.system);
  auto outcome = RestPivots::Outcome::moved;
  while (outcome == RestPivots::Outcome::moved) {
    outcome = pivots.revise(balance, step, model.point);
  }
  ASSERT_EQ(outcome, RestPivots::Outcome::lost);
  const std::string& text = pivots.lost_text();
  EXPECT_NE(text.find("\"under rod/"), std::string::npos) << text;
  EXPECT_NE(text.find("find no stand"), std::string::npos) << text;
  EXPECT_NE(text.find("stiffness"), std::string::npos) << text;
}

TEST(RestRows, EitherEndCarriesHalfOfTheWeight) {
  Resting model;
  const StaticReport report =
      find_static_equilibrium(model.built->model, model.state, model::RestFriction::frozen);
  ASSERT_EQ(report.rest.size(), model.rest.size());
  for (std::size_t k = 0; k < model.rest.size(); ++k) {
    const double expected = model.rest[k].kind == RestRow::Kind::one_sided ? 9.81 : 0.0;
    // Both ends could also pull at each other along the rod: rounding of the weight over the give
    // of rows that find their share, 1e-16 / 1e-6.
    EXPECT_NEAR(report.rest[k].force, expected, 1e-9 * 20.0) << model.rest.name(k);
    EXPECT_EQ(model.state.memory.at_rest[model.rest[k].load].force, report.rest[k].force);
  }
  EXPECT_TRUE(report.warnings.empty());
}

}  // namespace
}  // namespace buckens::analysis::test
