// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/base/errors.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::model_files {
namespace {

using Eigen::Vector3d;

constexpr const char* kTwins = R"(
buckens: 1
gravity: [0, -9.81 m/s^2, 0]
planar: xy
materials:
  steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}
bodies:
  left:
    beam:
      to: [500 mm, 0, 0]
      elements: 4
      section: {rectangle: {width: 4 mm, height: 20 mm}}
      material: steel
      masses: [{at: end, mass: 100 g}]
    damping: {stiffness: 1e-4 s}
    markers: {grip: {position: [400 mm, 0, 0]}}
  right:
    like: left
    at: {position: [3 m, 1 m, 0]}
joints:
  left_hinge: {revolute: {between: [ground, left/start]}}
  right_hinge: {revolute: {between: [{ground: [3 m, 1 m, 0]}, right/start]}}
simulation: {duration: 50 ms, step: 0.5 ms}
output:
  every: 1 ms
  sensors:
    left: {position: left/grip}
    right: {position: right/grip}
    left_bend: {deflection: left/mid}
    right_bend: {deflection: right/mid}
)";

TEST(Like, MakesASecondBodyOfTheSameMesh) {
  const auto built = model::build_model(model_file::read_model_text(kTwins, "twins.yaml"));
  const body::Body& left = built->model.bodies[0];
  const body::Body& right = built->model.bodies[1];
  EXPECT_EQ(right.name, "right");
  EXPECT_EQ(right.mass, left.mass);
  EXPECT_EQ(right.com, left.com);
  EXPECT_EQ(right.num_dofs(), left.num_dofs());
  EXPECT_EQ((right.flexible->C.whole() - left.flexible->C.whole()).norm(), 0);
  EXPECT_TRUE(right.flexible->is_damped());
  EXPECT_GE(right.find_marker("grip"), 0);
}

TEST(Like, MovesAsTheFirst) {
  const auto built = model::build_model(model_file::read_model_text(kTwins, "twins.yaml"));
  results::Table table;
  analysis::simulate(*built, table);
  const Eigen::MatrixXd left = table.values("sensors/left");
  const Eigen::MatrixXd right = table.values("sensors/right");
  ASSERT_GT(left.rows(), 10);
  // Fell by millimetres and bent by micrometres; another place in the world costs rounding, which
  // the Newton tolerance of 1e-10 hides.
  EXPECT_LT(left(left.rows() - 1, 1), -1e-3);
  const Eigen::MatrixXd moved = left.rowwise() + Vector3d(3, 1, 0).transpose();
  EXPECT_LT((right - moved).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::MatrixXd bend = table.values("sensors/left_bend");
  EXPECT_GT(bend.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((table.values("sensors/right_bend") - bend).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Like, NeedsABodyAboveIt) {
  std::string text = kTwins;
  text.replace(text.find("like: left"), 10, "like: lefd");
  EXPECT_THAT([&] { model_file::read_model_text(text, "twins.yaml"); },
              testing::ThrowsMessage<InputError>(testing::AllOf(testing::StartsWith("twins.yaml:"),
                                                                testing::HasSubstr("lefd"),
                                                                testing::HasSubstr("left"))));
}

}  // namespace
}  // namespace buckens::verification::model_files
