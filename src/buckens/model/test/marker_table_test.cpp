// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/marker_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/model/test/marker_of.h"

namespace buckens::model {
namespace {

using Eigen::Vector3d;
using test::Described;
using test::marker;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Nodal variables of the rigid motion u + θ × s about the mass centre.
linalg::Vector rigid_field(const body::Body& body, const Vector3d& u, const Vector3d& theta) {
  linalg::Vector d = linalg::Vector::Zero(body.num_dofs());
  const fem::FeModel& fe = body.flexible->fe;
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Vector3d translation = u + theta.cross(fe.nodes[n].position - body.com);
    for (int k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[n][static_cast<std::size_t>(k)];
      if (dof >= 0) d[dof] = k < 3 ? translation[k] : theta[k - 3];
    }
  }
  return d;
}

/// Beam from (1, 0, 0) to (3, 0, 0), all predefined markers asked for.
Described beam_with_sensors(int elements) {
  Described m;
  body::BodySpec& rod = m.beam("rod", {1, 0, 0}, {3, 0, 0}, elements);
  rod.markers = {Described::marker("inside", {1.2, 0, 0})};
  body::MarkerSpec turned;
  turned.name = "turned";
  turned.at = "end";
  turned.orientation.emplace();
  turned.orientation->axis = Vector3d::UnitZ();
  turned.orientation->angle = 0.3;
  rod.markers.push_back(turned);
  for (const char* name : {"start", "mid", "end", "com", "origin"}) {
    m.sensor_of<PositionSensor>(name, std::string("rod/") + name);
  }
  return m;
}

TEST(MarkerTable, PlacesPredefinedAndOwnMarkers) {
  const auto built = beam_with_sensors(4).build();
  const auto expect_at = [&](const std::string& name, const Vector3d& p_BF) {
    EXPECT_NEAR((marker(*built, name).X_BF.p - p_BF).norm(), 0, 1e-14) << name;
  };
  // From the mass centre (2, 0, 0) in model axes.
  expect_at("start", {-1, 0, 0});
  expect_at("mid", {0, 0, 0});
  expect_at("end", {1, 0, 0});
  expect_at("com", {0, 0, 0});
  expect_at("origin", {-2, 0, 0});
  expect_at("inside", {-0.8, 0, 0});
  expect_at("turned", {1, 0, 0});
  for (const char* name : {"start", "mid", "end", "inside", "turned"}) {
    EXPECT_TRUE(marker(*built, name).follows_mesh()) << name;
    EXPECT_TRUE(marker(*built, name).carries_moment()) << name;
  }
  // The mass centre is the body frame even where a node is; the model origin lies off this beam.
  EXPECT_FALSE(marker(*built, "com").follows_mesh());
  EXPECT_FALSE(marker(*built, "origin").follows_mesh());
  EXPECT_NEAR(
      marker(*built, "turned")
          .X_BF.q.angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()))),
      0, 1e-15);
  // Two markers at one node share its rows.
  EXPECT_EQ(marker(*built, "turned").translation_row, marker(*built, "end").translation_row);
  EXPECT_EQ(marker(*built, "start").node, 0);
  EXPECT_GE(marker(*built, "mid").node, 0);
  EXPECT_EQ(marker(*built, "inside").node, -1);
}

TEST(MarkerTable, MidOfAnOddBeamLiesInsideAnElement) {
  const auto built = beam_with_sensors(3).build();
  EXPECT_NEAR(marker(*built, "mid").X_BF.p.norm(), 0, 1e-14);
  EXPECT_EQ(marker(*built, "mid").node, -1);
  EXPECT_TRUE(marker(*built, "mid").follows_mesh());
}

TEST(MarkerTable, RowsReproduceRigidMotion) {
  for (const int elements : {3, 4}) {
    const auto built = beam_with_sensors(elements).build();
    const body::Body& body = built->model.bodies[0];
    const Vector3d u(0.1, -0.2, 0.3);
    const Vector3d theta(0.01, 0.02, -0.03);
    const Eigen::VectorXd y = body.row_values(rigid_field(body, u, theta));
    for (const char* name : {"start", "mid", "end", "inside"}) {
      const body::Marker& m = marker(*built, name);
      // Shape functions hold rigid motion exactly: rounding only.
      EXPECT_NEAR((y.segment<3>(m.translation_row) - u - theta.cross(m.X_BF.p)).norm(), 0, 1e-15)
          << name;
      EXPECT_NEAR((y.segment<3>(m.rotation_row) - theta).norm(), 0, 1e-15) << name;
    }
  }
}

TEST(MarkerTable, OriginOnTheMeshFollowsIt) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2);
  m.force("push", "rod/origin", {1, 0, 0});
  m.sensor_of<PositionSensor>("start", "rod/start");
  const auto built = m.build();
  EXPECT_EQ(marker(*built, "origin").node, marker(*built, "start").node);
  EXPECT_EQ(marker(*built, "origin").translation_row, marker(*built, "start").translation_row);
}

TEST(MarkerTable, InterfaceRowsComeFirst) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  m.sensor_of<PositionSensor>("first", "rod/mid");
  m.joint<joints::SphericalSpec>("ball", "ground", "rod/end");
  m.force("push", "rod/start", {1, 0, 0});
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.num_interface_rows(), 12);
  EXPECT_EQ(body.num_rows(), 18);
  EXPECT_EQ(marker(*built, "end").translation_row, 0);
  EXPECT_EQ(marker(*built, "start").translation_row, 6);
  EXPECT_GE(marker(*built, "mid").translation_row, 12);
}

TEST(MarkerTable, OwnMarkersMustLieOnTheMesh) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2).markers = {Described::marker("off", {0.5, 0.1, 0})};
  EXPECT_THAT([&] { m.build(); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.yaml:40:1"), HasSubstr("\"off\""),
                                              HasSubstr("lie on its mesh"))));
}

TEST(MarkerTable, RigidBodiesCarryMarkersAnywhere) {
  Described m;
  m.rigid("block", 1, {1, 0, 0}, {1, 1, 1}).markers = {Described::marker("p", {1, 2, 3})};
  m.sensor_of<PositionSensor>("origin", "block/origin");
  const auto built = m.build();
  EXPECT_EQ(marker(*built, "p").X_BF.p, Vector3d(0, 2, 3));
  EXPECT_EQ(marker(*built, "origin").X_BF.p, Vector3d(-1, 0, 0));
  EXPECT_TRUE(marker(*built, "p").carries_moment());
}

}  // namespace
}  // namespace buckens::model
