// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/model_report.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/model/test/described.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;

TEST(ModelReport, DescribesARigidBody) {
  Described m;
  m.rigid("block", 2, {1, 0, 0}, {3, 1, 2}).markers = {Described::marker("pin", {0, 0, 0})};
  m.joint<joints::RevoluteSpec>("hinge", "ground", "block/pin").axis = Vector3d::UnitZ();
  const ModelReport report = report_model(*m.build());
  ASSERT_EQ(report.bodies.size(), 1U);
  const BodyReport& body = report.bodies[0];
  EXPECT_EQ(body.name, "block");
  EXPECT_FALSE(body.is_flexible);
  EXPECT_EQ(body.mass, 2);
  EXPECT_EQ(body.com, Vector3d(1, 0, 0));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(body.principal_inertia[k], 1.0 + static_cast<double>(k), 1e-14);
  }
  EXPECT_EQ(body.dof, 0);
  EXPECT_EQ(body.frame_coordinates, 6);
  EXPECT_THAT(body.markers, testing::ElementsAre("pin"));
  EXPECT_EQ(report.joints, 1);
  EXPECT_EQ(report.constraint_rows, 5);
  EXPECT_EQ(report.redundant_rows, 0);
  EXPECT_EQ(report.degrees_of_freedom, 1);
  EXPECT_EQ(report.highest_frequency, 0);
}

TEST(ModelReport, CountsFreedomsOfALinkage) {
  // Four-bar linkage in space with hinges: 18 coordinates, 20 rows, 3 of them redundant.
  Described m;
  const Vector3d corners[] = {{0, 0, 0}, {0, 1, 0}, {2, 1, 0}, {2, 0, 0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d along = corners[k + 1] - corners[k];
    body::BodySpec& bar = m.rigid("bar" + std::to_string(k), 1, 0.5 * along, {0.1, 0.1, 0.1});
    bar.at.position = corners[k];
    bar.markers = {Described::marker("a", {0, 0, 0}), Described::marker("b", along)};
  }
  const auto hinge = [&](const std::string& name, const std::string& a, const std::string& b) {
    auto& joint = m.joint<joints::RevoluteSpec>(name, a, b);
    joint.axis = Vector3d::UnitZ();
    return &joint;
  };
  hinge("h0", "ground", "bar0/a");
  hinge("h1", "bar0/b", "bar1/a");
  hinge("h2", "bar1/b", "bar2/a");
  hinge("h3", "ground", "bar2/b")->between[0].point = corners[3];
  const ModelReport report = report_model(*m.build());
  EXPECT_EQ(report.constraint_rows, 20);
  EXPECT_EQ(report.redundant_rows, 3);
  EXPECT_EQ(report.degrees_of_freedom, 1);
  EXPECT_LT(report.assembly_gap, 1e-12);
  EXPECT_FALSE(report.redundant.empty());
}

TEST(ModelReport, KnowsTheFrequenciesOfAFreeBeam) {
  Described m;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 8);
  m.force("push", "rod/end", {0, 1, 0});
  m.d.simulation.emplace();
  m.d.simulation->duration = 1;
  m.d.simulation->step = 0.1;
  m.d.output.every = 1e-3;  // records that show what the step does not follow
  const ModelReport report = report_model(*m.build());
  const BodyReport& body = report.bodies[0];
  EXPECT_TRUE(body.is_flexible);
  EXPECT_EQ(body.nodes, 9);
  EXPECT_EQ(body.elements, 8);
  EXPECT_EQ(body.dof, 54);
  ASSERT_EQ(body.frequencies.size(), 10U);
  // Free-free Euler–Bernoulli beam: (λL)² = 4.73004² in the weak plane, 3/2 of it in the other.
  using namespace model::test;
  const double weak =
      std::pow(4.730041 / 2, 2) * std::sqrt(kE * kIz / (kRho * kArea)) / (2 * std::numbers::pi);
  EXPECT_NEAR(body.frequencies[0], weak, 1e-3 * weak);
  EXPECT_NEAR(body.frequencies[1], 1.5 * weak, 1.5e-3 * weak);
  EXPECT_EQ(report.degrees_of_freedom, 6);
  EXPECT_EQ(report.loads, 1);
  // A step of 0.1 s does not follow 50 Hz.
  EXPECT_EQ(report.step, 0.1);
  EXPECT_GE(report.highest_frequency, weak);
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_THAT(report.warnings[0], testing::HasSubstr("\"rod\""));
}

}  // namespace
}  // namespace buckens::analysis
