// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/row_watch.h"

#include <gtest/gtest.h>

#include "buckens/dynamics/test/mechanism.h"

namespace buckens::stepping {
namespace {

/// A body on two revolute joints; the length of the model is 10 m.
class RowWatchTest : public testing::Test {
 protected:
  RowWatchTest() {
    test::Mechanism m;
    m.set_length(10.0);
    const int body = m.add_rigid(1.0, Eigen::Matrix3d::Identity(), {});
    for (const double z : {0.0, 1.0}) {
      m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, z}),
                  m.rigid_marker(body, {0, 0, z}));
    }
    model = m.take();
    residuals.g = linalg::Vector::Zero(10);
    residuals.g_dot = linalg::Vector::Zero(10);
  }

  model::Model model;
  dynamics::JointResiduals residuals;
  const std::vector<int> place = {0, 1, 2, 3, 4, -1, -1, -1, -1, -1};
  StepReport report;
};

TEST_F(RowWatchTest, MeasuresLengthsByTheModel) {
  RowWatch watch(model);
  residuals.g[2] = 1e-3;      // m
  residuals.g_dot[4] = -0.5;  // rad/s
  EXPECT_EQ(watch.look(residuals, place, report), -1);
  EXPECT_DOUBLE_EQ(report.opening, 1e-4);
  EXPECT_EQ(report.most_open_row, 2);
  EXPECT_DOUBLE_EQ(report.opening_rate, 0.5);
  EXPECT_FALSE(watch.has_open_rows());
}

TEST_F(RowWatchTest, ARowThatOpensAsksForAChoiceFirst) {
  RowWatch watch(model);
  residuals.g[6] = 9e-9;  // 9e-10 of the length: closed
  EXPECT_EQ(watch.look(residuals, place, report), -1);
  EXPECT_FALSE(watch.has_open_rows());
  residuals.g[6] = 2e-8;
  EXPECT_EQ(watch.look(residuals, place, report), -1);
  EXPECT_TRUE(watch.has_open_rows());
  watch.rows_are_chosen();
  EXPECT_EQ(watch.look(residuals, place, report), -1);
  EXPECT_FALSE(watch.has_open_rows());  // no wider open than when they were chosen
}

TEST_F(RowWatchTest, ARowThatIsWideOpenContradicts) {
  RowWatch watch(model);
  residuals.g[9] = 2e-6;  // rad
  residuals.g[6] = 3e-6;  // m, which is less
  EXPECT_EQ(watch.look(residuals, place, report), 9);
  EXPECT_TRUE(watch.has_open_rows());
}

TEST_F(RowWatchTest, RowsThatDriftTogetherDoNotContradict) {
  RowWatch watch(model);
  residuals.g[3] = 1e-5;
  residuals.g[9] = 2e-5;
  EXPECT_EQ(watch.look(residuals, place, report), -1);
  residuals.g[9] = 2e-4;
  EXPECT_EQ(watch.look(residuals, place, report), 9);
}

}  // namespace
}  // namespace buckens::stepping
