// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/statics/path.h"
#include "buckens/analysis/test/static_models.h"
#include "buckens/base/errors.h"
#include "buckens/results/table.h"

namespace buckens::analysis::test {
namespace {

using results::Table;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Traced {
  std::unique_ptr<model::BuiltModel> built;
  Table table;
  results::RunSummary summary;

  double last(const std::string& channel, Eigen::Index component = 0) const {
    const Eigen::MatrixXd values = table.values(channel);
    return values(values.rows() - 1, component);
  }
};

std::unique_ptr<Traced> trace(const Mechanism& mechanism) {
  auto out = std::make_unique<Traced>();
  out->built = mechanism.build();
  out->summary = trace_static_path(*out->built, out->table);
  return out;
}

void position_sensor(Mechanism& m, const std::string& name, const std::string& of) {
  model::SensorSpec spec;
  spec.name = name;
  model::DisplacementSensor sensor;
  sensor.of = at_marker(of);
  spec.kind = sensor;
  m.description.output.sensors.push_back(spec);
}

Mechanism cantilever(const Vector3d& gravity = {0, 0, 0}) {
  Mechanism m(gravity);
  m.planar();
  m.beam("beam", 1.0, 4);
  m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  position_sensor(m, "tip", "beam/end");
  return m;
}

/// A rod upright on a hinge with a torsional spring, loaded at its end.
Mechanism sprung_rod(double stiffness, const Vector3d& force) {
  Mechanism m({0, 0, 0});
  m.planar();
  m.rigid_rod("rod", 2.0, 1.0, {0, 0, 0}, std::numbers::pi / 2);
  m.joint<joints::RevoluteSpec>("hinge", at_marker("ground"), at_marker("rod/s"));
  auto& spring = m.load<loads::TorsionalSpringSpec>("spring");
  spring.between = {at_marker("ground"), at_marker("rod")};
  spring.stiffness = stiffness;
  m.force("rod/e", force);
  position_sensor(m, "end", "rod/e");
  return m;
}

TEST(StaticPath, LoadStepsLieOnTheLineOfASmallDeflection) {
  Mechanism m = cantilever();
  const double F = 0.5;
  m.force("beam/end", {0, F, 0});
  m.description.static_path.emplace();
  m.description.static_path->method = model::StaticMethod::load;
  m.description.static_path->steps = 5;
  const auto path = trace(m);
  EXPECT_TRUE(path->summary.finished);
  EXPECT_EQ(path->summary.steps, 5);
  const Eigen::MatrixXd factor = path->table.values("sensors/load-factor");
  const Eigen::MatrixXd tip = path->table.values("sensors/tip");
  ASSERT_EQ(factor.rows(), 6);
  for (Eigen::Index k = 0; k < 6; ++k) {
    EXPECT_NEAR(factor(k, 0), 0.2 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(path->table.times()[static_cast<std::size_t>(k)], static_cast<double>(k), 1e-12);
    // Euler–Bernoulli elements are exact at nodes; the end's turn of 6e-5 rad leaves its square.
    EXPECT_NEAR(tip(k, 1), factor(k, 0) * F / (3 * kE * kIz), 4e-9 * F / (3 * kE * kIz));
  }
}

TEST(StaticPath, GravityIsNotMultiplied) {
  Mechanism m = cantilever({0, -9.81, 0});
  m.force("beam/end", {0, 100.0, 0});
  m.description.static_path.emplace();
  m.description.static_path->load_factor = {0.0, 2.0};
  const auto path = trace(m);
  Mechanism loaded = cantilever({0, -9.81, 0});
  loaded.force("beam/end", {0, 200.0, 0});
  const auto built = loaded.build();
  model::State state = model::placed_state(built->model);
  find_static_equilibrium(built->model, state);
  EXPECT_EQ(path->last("sensors/load-factor"), 2.0);
  EXPECT_NEAR(path->last("bodies/beam/pose", 1), state.bodies[0].frame.X_WB.p.y(), 1e-12);
}

// Column on a hinge with torsional spring: it stands straight, unstable beyond P = k/l.
TEST(StaticPath, FindsTheBifurcationOfAColumnOnASpring) {
  const double k = 30.0;
  const double l = 2.0;
  Mechanism m = sprung_rod(k, {0, -2.0 * k / l, 0});
  m.description.static_path.emplace();
  m.description.static_path->arc_step = 0.2;
  const auto path = trace(m);
  EXPECT_TRUE(path->summary.finished);
  const auto& points = path->summary.static_path->critical_points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].kind, "bifurcation");
  EXPECT_NEAR(points[0].load_factor, 0.5, 1e-6);  // differences of the tangent: 1e-10 of k
  EXPECT_EQ(path->last("static/unstable"), 1.0);
}

// The same with a lateral force of 1 %: k φ = μ (P l sin φ + H l cos φ) at every point.
TEST(StaticPath, FollowsAnImperfectColumnFarBeyondItsBucklingLoad) {
  const double k = 30.0;
  const double l = 2.0;
  const double P = 2.0 * k / l;
  const double H = 0.01 * P;
  Mechanism m = sprung_rod(k, {H, -P, 0});
  const auto path = trace(m);
  EXPECT_TRUE(path->summary.finished);
  EXPECT_TRUE(path->summary.static_path->critical_points.empty());
  const Eigen::MatrixXd factor = path->table.values("sensors/load-factor");
  const Eigen::MatrixXd end = path->table.values("sensors/end");
  double largest = 0.0;
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    const double phi = std::atan2(end(i, 0), l + end(i, 1));  // to the right of upright
    const double left = k * phi;
    const double right = factor(i, 0) * l * (P * std::sin(phi) + H * std::cos(phi));
    EXPECT_NEAR(left, right, 1e-10 * k);  // rounding of angles and forces
    largest = std::max(largest, phi);
  }
  EXPECT_GT(largest, 1.5);  // rad: k φ = 2 k sin φ at 1.9
  // Work by the trapezoidal rule with steps of 0.05 rad errs by about their square over twelve.
  EXPECT_LT(path->summary.energy_error, 1e-3);
}

TEST(StaticPath, EndsWhereASensorPassesAValue) {
  const double k = 30.0;
  Mechanism m = sprung_rod(k, {0.3, -k, 0});
  m.description.static_path.emplace();
  m.description.static_path->stop = model::StaticStopSpec{{}, "end", "x", 0.4};
  const auto path = trace(m);
  EXPECT_TRUE(path->summary.finished);
  EXPECT_GE(path->last("sensors/end", 0), 0.4);
  EXPECT_LT(path->last("sensors/load-factor"), 1.0);
  m.description.static_path->stop->component = "u";
  EXPECT_THAT([&] { trace(m); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("\"end.u\""), HasSubstr("end.x"))));
}

TEST(StaticPath, RefusesAMechanismAndNamesTheMotion) {
  Mechanism m({0, 0, 0});
  m.rigid_rod("door", 1.0, 1.0);
  m.joint<joints::RevoluteSpec>("hinge", at_marker("ground"), at_marker("door/s"));
  m.force("door/e", {1, 0, 0});
  EXPECT_THAT([&] { trace(m); },
              ThrowsMessage<ModelError>(
                  AllOf(HasSubstr("body \"door\" turns about (0, 0, "), HasSubstr("load-factor"))));
  // Held by the load itself it can be traced: the rod points along the force.
  m.description.static_path.emplace();
  m.description.static_path->load_factor = {0.5, 1.0};
  EXPECT_TRUE(trace(m)->summary.finished);
}

TEST(StaticPath, NeedsALoadToMultiply) {
  EXPECT_THAT(
      [&] {
        trace(cantilever({0, -9.81, 0}));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("no load"), HasSubstr("time"))));
}

TEST(StaticPath, LoadControlTellsOfTheLimitPoint) {
  // A rod at 45 degrees on a hinge, its end guided by a spring along x: snaps through.
  Mechanism m({0, 0, 0});
  m.planar();
  m.rigid_rod("rod", 1.0, 1.0, {0, 0, 0}, 0.5);
  m.joint<joints::RevoluteSpec>("hinge", at_marker("ground"), at_marker("rod/s"));
  auto& spring = m.load<loads::SpringDamperSpec>("spring");
  spring.between = {ground_at({2 * std::cos(0.5), 0, 0}), at_marker("rod/e")};
  spring.stiffness = 1000.0;
  m.force("rod/e", {0, -200.0, 0});
  m.description.static_path.emplace();
  m.description.static_path->method = model::StaticMethod::load;
  Table table;
  const auto built = m.build();
  EXPECT_THAT([&] { trace_static_path(*built, table); },
              ThrowsMessage<NumericalError>(
                  AllOf(HasSubstr("limit point"), HasSubstr("method: arc-length"))));
  ASSERT_TRUE(table.summary());
  EXPECT_FALSE(table.summary()->finished);
  EXPECT_GT(table.num_records(), 2U);

  m.description.static_path->method = model::StaticMethod::arc_length;
  const auto path = trace(m);
  EXPECT_TRUE(path->summary.finished);
  ASSERT_EQ(path->summary.static_path->critical_points.size(), 2U);
  // Both limits are the same upside down.
  EXPECT_NEAR(path->summary.static_path->critical_points[0].load_factor,
              -path->summary.static_path->critical_points[1].load_factor, 1e-9);
  EXPECT_NEAR(path->summary.static_path->critical_points[0].load_factor,
              table.values("sensors/load-factor").maxCoeff(), 1e-3);
}

TEST(StaticPath, CanBeInterrupted) {
  Mechanism m = cantilever();
  m.force("beam/end", {0, 1, 0});
  const auto built = m.build();
  Table table;
  StaticPathOptions options;
  options.stop_reason = "enough";
  options.on_progress = [](const StaticProgress& progress) { return progress.point < 3; };
  const auto summary = trace_static_path(*built, table, options);
  EXPECT_FALSE(summary.finished);
  EXPECT_EQ(summary.interrupted, "enough");
  EXPECT_EQ(table.num_records(), 3U);
}

}  // namespace
}  // namespace buckens::analysis::test
