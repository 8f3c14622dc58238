// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/node_region.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/fem/mesh/region_spec.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using linalg::Vector;

const Vector3d kSize(0.4, 0.2, 0.3);

struct Mesh {
  Structure structure;
  FeModel fe;

  explicit Mesh(SolidKind kind = SolidKind::hex8) {
    add_box(structure, {{0.1, -0.1, 0.0}, kSize, {3, 2, 4}}, Material::isotropic(2e9, 0.3, 1200),
            SolidForm::usual(kind));
    fe = assemble(structure);
  }
  NodeRegion face(const char* name) const {
    return face_region(structure, *find_face_set(structure, name));
  }
};

/// Rows as a dense matrix, three translations and three rotations.
linalg::Matrix dense(const PointRows& rows, int n) {
  linalg::Matrix out = linalg::Matrix::Zero(6, n);
  for (const auto& entry : rows.translation) out(entry.row(), entry.col()) += entry.value();
  for (const auto& entry : rows.rotation) out(3 + entry.row(), entry.col()) += entry.value();
  return out;
}

/// Nodal variables of a rigid motion about the origin.
Vector rigid(const FeModel& fe, const Vector3d& u, const Vector3d& theta) {
  Vector d(fe.dofs.num_dofs);
  for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
    const Vector3d moved = u + theta.cross(fe.nodes[k].position);
    for (std::size_t a = 0; a < 3; ++a) {
      d[fe.dofs.node_dofs[k][a]] = moved[static_cast<Eigen::Index>(a)];
    }
  }
  return d;
}

class Regions : public testing::TestWithParam<SolidKind> {};

TEST_P(Regions, FacesHaveTheirAreaAndCentre) {
  const Mesh mesh(GetParam());
  const NodeRegion region = mesh.face("x1");
  EXPECT_NEAR(region.area, kSize.y() * kSize.z(), 1e-15);
  EXPECT_NEAR((region.centre - Vector3d(0.5, 0.0, 0.15)).norm(), 0, 1e-15);
  EXPECT_NEAR(region.weights.sum(), 1, 1e-14);
  EXPECT_GT(region.weights.minCoeff(), 0);
  EXPECT_TRUE(region.turns());
}

TEST_P(Regions, ASelectionOfThePlaneIsTheFace) {
  const Mesh mesh(GetParam());
  PlaneSelection plane;
  plane.point = {0.5, 7, 8};
  plane.normal = {-3, 0, 0};
  std::vector<int> nodes;
  for (std::size_t k = 0; k < mesh.fe.nodes.size(); ++k) {
    if (distance(plane, mesh.fe.nodes[k].position) < 1e-9) nodes.push_back(static_cast<int>(k));
  }
  const NodeRegion selected = node_region(mesh.structure, nodes);
  const NodeRegion face = mesh.face("x1");
  EXPECT_EQ(selected.nodes, face.nodes);
  EXPECT_NEAR((selected.weights - face.weights).norm(), 0, 1e-14);
  EXPECT_NEAR(selected.area, face.area, 1e-15);
}

TEST_P(Regions, FollowRigidMotionExactly) {
  const Mesh mesh(GetParam());
  const Vector3d at(0.7, 0.1, -0.2), u(1, -2, 3), theta(0.3, 0.5, -0.7);
  const Vector d = rigid(mesh.fe, u, theta);
  for (const char* name : {"x0", "y1", "z0"}) {
    const PointRows rows = region_rows(mesh.fe, mesh.face(name), at);
    const Vector y = dense(rows, mesh.fe.dofs.num_dofs) * d;
    EXPECT_NEAR((y.head<3>() - u - theta.cross(at)).norm(), 0, 1e-13) << name;
    EXPECT_NEAR((y.tail<3>() - theta).norm(), 0, 1e-13) << name;
  }
}

TEST_P(Regions, ShareOutForceAndMomentWithTheirResultant) {
  const Mesh mesh(GetParam());
  const Vector3d at(0.55, 0.02, 0.1), force(3, -4, 5), moment(-1, 2, 0.5);
  const PointRows rows = region_rows(mesh.fe, mesh.face("x1"), at);
  Vector wrench(6);
  wrench << force, moment;
  const Vector loads = dense(rows, mesh.fe.dofs.num_dofs).transpose() * wrench;
  Vector3d sum = Vector3d::Zero(), turning = Vector3d::Zero();
  for (std::size_t k = 0; k < mesh.fe.nodes.size(); ++k) {
    Vector3d own;
    for (std::size_t a = 0; a < 3; ++a) {
      own[static_cast<Eigen::Index>(a)] = loads[mesh.fe.dofs.node_dofs[k][a]];
    }
    sum += own;
    turning += (mesh.fe.nodes[k].position - at).cross(own);
  }
  EXPECT_NEAR((sum - force).norm(), 0, 1e-12);
  EXPECT_NEAR((turning - moment).norm(), 0, 1e-12);
}

TEST_P(Regions, FitsLeaveTheLeastWeightedSquares) {
  // The gradient of Σ w |u_i − u − θ × r_i|² vanishes: for any d, the misfit has neither mean nor
  // moment.
  const Mesh mesh(GetParam());
  const NodeRegion region = mesh.face("y0");
  const Vector d = Vector::Random(mesh.fe.dofs.num_dofs);
  const Vector y = dense(region_rows(mesh.fe, region, region.centre), mesh.fe.dofs.num_dofs) * d;
  Vector3d mean = Vector3d::Zero(), moment = Vector3d::Zero();
  for (std::size_t k = 0; k < region.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(region.nodes[k]);
    Vector3d own;
    for (std::size_t a = 0; a < 3; ++a) {
      own[static_cast<Eigen::Index>(a)] = d[mesh.fe.dofs.node_dofs[node][a]];
    }
    const Vector3d r = mesh.fe.nodes[node].position - region.centre;
    const Vector3d turned = Vector3d(y.tail<3>()).cross(r);
    const Vector3d misfit = own - Vector3d(y.head<3>()) - turned;
    mean += region.weights[static_cast<Eigen::Index>(k)] * misfit;
    moment += region.weights[static_cast<Eigen::Index>(k)] * r.cross(misfit);
  }
  EXPECT_NEAR(mean.norm(), 0, 1e-14);
  EXPECT_NEAR(moment.norm(), 0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Regions,
                         testing::Values(SolidKind::hex8, SolidKind::hex20, SolidKind::tet4,
                                         SolidKind::tet10),
                         [](const auto& kind) {
                           return std::string(
                               choice_names(SolidKind{})[static_cast<std::size_t>(kind.param)]);
                         });

TEST(NodeRegion, OfALineTellsNoRotation) {
  const Mesh mesh;
  std::vector<int> edge;
  for (std::size_t k = 0; k < mesh.fe.nodes.size(); ++k) {
    const Vector3d& x = mesh.fe.nodes[k].position;
    if (x.x() < 0.101 && x.z() < 0.001) edge.push_back(static_cast<int>(k));
  }
  ASSERT_EQ(edge.size(), 3u);
  const NodeRegion line = node_region(mesh.structure, edge);
  EXPECT_FALSE(line.turns());
  EXPECT_EQ(line.area, 0);
  EXPECT_NEAR((line.weights - Eigen::Vector3d::Constant(1.0 / 3)).norm(), 0, 1e-15);
  EXPECT_FALSE(region_rows(mesh.fe, line, line.centre).has_rotation);
  EXPECT_FALSE(node_region(mesh.structure, {0}).turns());
}

TEST(NodeRegion, NodesInsideTheMeshHaveNoShareOfItsSurface) {
  const Mesh mesh;
  std::vector<int> all(mesh.fe.nodes.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
  const NodeRegion region = node_region(mesh.structure, all);
  const double surface =
      2 * (kSize.x() * kSize.y() + kSize.y() * kSize.z() + kSize.z() * kSize.x());
  EXPECT_NEAR(region.area, surface, 1e-14);
  int inside = 0;
  for (Eigen::Index k = 0; k < region.weights.size(); ++k) inside += region.weights[k] == 0 ? 1 : 0;
  EXPECT_EQ(inside, 2 * 1 * 3);
}

TEST(NodeRegion, RenumberedKeepsWeightsWithTheirNodes) {
  const Mesh mesh;
  const NodeRegion face = mesh.face("x0");
  std::vector<int> reversed;
  for (const int node : face.nodes) reversed.push_back(1000 - node);
  const NodeRegion out = renumbered(face, reversed);
  EXPECT_TRUE(std::is_sorted(out.nodes.begin(), out.nodes.end()));
  EXPECT_EQ(out.weights.reverse(), face.weights);
}

TEST(Selections, MeasureDistancesFromWhatTheyCover) {
  SphereSelection sphere;
  sphere.center = {1, 0, 0};
  sphere.radius = 2;
  EXPECT_EQ(distance(sphere, {2, 0, 0}), 0);
  EXPECT_NEAR(distance(sphere, {1, 3, 4}), 3, 1e-15);
  BoxSelection box;
  box.from = {1, 1, 1};
  box.to = {0, 0, 0};
  EXPECT_EQ(distance(box, {0.5, 0.2, 1}), 0);
  EXPECT_NEAR(distance(box, {4, 5, 0.5}), 5, 1e-15);
  CylinderSelection cylinder;
  cylinder.from = {0, 0, 0};
  cylinder.to = {0, 0, 2};
  cylinder.radius = 1;
  EXPECT_EQ(distance(cylinder, {0.6, 0.8, 1}), 0);
  EXPECT_NEAR(distance(cylinder, {0, 4, 1}), 3, 1e-15);
  EXPECT_NEAR(distance(cylinder, {0, 4, 6}), 5, 1e-15);
  EXPECT_NEAR(distance(cylinder, {0.5, 0, -2}), 2, 1e-15);
}

}  // namespace
}  // namespace buckens::fem
