// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/elimination.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A block of solids with a beam beside it.
struct Parts {
  Structure s;
  int block = 0, near = 0, far = 0, hub = 0;

  Parts() {
    block = add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {2, 1, 1}}, test::steel());
    near = add_node(s, "near", {0.6, 0.1, 0.15});
    far = add_node(s, "far", {1.1, 0.3, 0.1});
    hub = add_node(s, "hub", {0.5, 0.15, 0.1});
    add_beam(s, near, far, 2, test::beam_properties(BeamTheory::timoshenko, true));
  }
  std::vector<int> face_x1() const { return {block + 2, block + 5, block + 8, block + 11}; }
  static RigidLink rigid(int reference, std::vector<int> nodes) {
    return {"link", reference, std::move(nodes)};
  }
  static AverageLink average(int reference, std::vector<int> nodes, std::vector<double> weights) {
    AverageLink out;
    out.label = "mean";
    out.reference = reference;
    out.nodes = std::move(nodes);
    out.weights = std::move(weights);
    return out;
  }
};

/// T permits rigid motion and is the identity on independent rows.
void expect_rigid_motion(const FeModel& fe, const Elimination& e) {
  const Matrix Phi = test::rigid_motions(fe);
  Matrix x(e.dofs.num_dofs, 6);
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    for (std::size_t k = 0; k < 6; ++k) {
      const int own = e.dofs.node_dofs[n][k], all = fe.dofs.node_dofs[n][k];
      if (own >= 0) x.row(own) = Phi.row(all);
    }
  }
  EXPECT_LE((e.T * x - Phi).norm(), 1e-13 * Phi.norm());
}

Vector moved(const FeModel& fe, const Elimination& e, int node) {
  const Vector d = e.T * Vector::LinSpaced(e.dofs.num_dofs, -1.0, 2.0);
  Vector out = Vector::Zero(6);
  for (std::size_t k = 0; k < 6; ++k) {
    const int dof = fe.dofs.node_dofs[static_cast<std::size_t>(node)][k];
    if (dof >= 0) out[static_cast<Eigen::Index>(k)] = d[dof];
  }
  return out;
}

void expect_rigid(const FeModel& fe, const Elimination& e, int reference, int node) {
  const Vector a = moved(fe, e, reference), b = moved(fe, e, node);
  const Vector3d r = fe.nodes[static_cast<std::size_t>(node)].position -
                     fe.nodes[static_cast<std::size_t>(reference)].position;
  const Vector3d turn = a.tail<3>();
  EXPECT_LE((a.head<3>() + turn.cross(r) - b.head<3>()).norm(), 1e-12) << node;
}

TEST(Elimination, FollowsRigidLinksInChainsAndLoops) {
  Parts p;
  // near carries the face, hub follows near, and a node of the face is tied to hub once more.
  p.s.links.rigid = {Parts::rigid(p.hub, {p.near}), Parts::rigid(p.near, p.face_x1()),
                     Parts::rigid(p.hub, {p.block + 2})};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  for (const int node : p.face_x1()) {
    expect_rigid(fe, e, p.near, node);
    expect_rigid(fe, e, p.hub, node);
  }
  // 12 + 6 variables are dependent; the third link is redundant.
  EXPECT_EQ(e.dofs.num_dofs, fe.dofs.num_dofs - 18);
  EXPECT_TRUE(e.is_free[static_cast<std::size_t>(p.far)]);
  EXPECT_FALSE(e.is_free[static_cast<std::size_t>(p.near)]);
}

TEST(Elimination, TiesReferencesThatShareANode) {
  Parts p;
  const auto face = p.face_x1();
  p.s.links.rigid = {Parts::rigid(p.near, {face[0], face[1]}),
                     Parts::rigid(p.hub, {face[1], face[2], face[3]})};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  for (const int node : {face[0], face[1]}) expect_rigid(fe, e, p.near, node);
  for (const int node : {face[1], face[2], face[3]}) expect_rigid(fe, e, p.hub, node);
  EXPECT_EQ(e.dofs.num_dofs, fe.dofs.num_dofs - 15);
}

TEST(Elimination, KeepsVariablesThatAMaskLeavesFree) {
  Parts p;
  RigidLink link = Parts::rigid(p.hub, {p.near});
  link.variables = {true, false, true, false, false, true};
  p.s.links.rigid = {link, Parts::rigid(p.hub, p.face_x1())};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  const auto& own = e.dofs.node_dofs[static_cast<std::size_t>(p.near)];
  EXPECT_THAT(own,
              testing::ElementsAre(-1, testing::Ge(0), -1, testing::Ge(0), testing::Ge(0), -1));
}

TEST(Elimination, AveragesAsInterfacesDo) {
  Parts p;
  p.s.links.averages = {Parts::average(p.near, p.face_x1(), {1, 2, 1, 3})};
  p.s.links.rigid = {Parts::rigid(p.near, {p.hub})};  // follows what follows
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  expect_rigid(fe, e, p.near, p.hub);
  EXPECT_EQ(e.dofs.num_dofs, fe.dofs.num_dofs - 12);
  // With the weights moved to one node the fit is that of two nodes of the same place.
  const Vector d = e.T * Vector::LinSpaced(e.dofs.num_dofs, -1.0, 2.0);
  const NodeRegion region = weighted_region(fe.nodes, p.face_x1(), {1, 2, 1, 3});
  const PointRows rows =
      region_rows(fe, region, fe.nodes[static_cast<std::size_t>(p.near)].position);
  Vector expected = Vector::Zero(6);
  for (const auto& entry : rows.translation)
    expected[entry.row()] += entry.value() * d[entry.col()];
  for (const auto& entry : rows.rotation)
    expected[3 + entry.row()] += entry.value() * d[entry.col()];
  EXPECT_LE((moved(fe, e, p.near) - expected).norm(), 1e-12);
}

TEST(Elimination, AveragesMoveTheChosenVariablesOnly) {
  Parts p;
  p.s.links.averages = {
      {"mean", p.near, p.face_x1(), {1, 1, 1, 1}, {true, true, false, true, false, false}, {}}};
  p.s.links.rigid = {Parts::rigid(p.near, {p.hub})};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  EXPECT_THAT(e.dofs.node_dofs[static_cast<std::size_t>(p.near)],
              testing::ElementsAre(-1, -1, testing::Ge(0), -1, testing::Ge(0), testing::Ge(0)));
  // A node without other rotations gets rotations only if the average determines all three.
  Parts q;
  q.s.links.rigid = {Parts::rigid(q.near, q.face_x1())};  // holds the beam
  q.s.links.averages = {
      {"mean", q.hub, q.face_x1(), {1, 1, 1, 1}, {true, true, true, false, false, false}, {}}};
  const FeModel without = assemble(q.s);
  EXPECT_EQ(without.dofs.node_dofs[static_cast<std::size_t>(q.hub)][3], -1);
  q.s.links.averages[0].variables.fill(true);
  EXPECT_GE(assemble(q.s).dofs.node_dofs[static_cast<std::size_t>(q.hub)][3], 0);
}

TEST(Elimination, AveragesOfAllComponentsAreThoseWithoutChoice) {
  Parts p;
  p.s.links.averages = {Parts::average(p.near, p.face_x1(), {1, 2, 1, 3})};
  p.s.links.rigid = {Parts::rigid(p.near, {p.hub})};
  const FeModel fe = assemble(p.s);
  const Elimination plain = eliminate(fe.nodes, fe.dofs, p.s.links);
  p.s.links.averages[0].components.assign(4, {true, true, true});
  const Elimination fitted = eliminate(fe.nodes, fe.dofs, p.s.links);
  // Two ways to solve the same least squares, both well conditioned.
  EXPECT_LE((Matrix(plain.T) - Matrix(fitted.T)).norm(), 1e-12 * Matrix(plain.T).norm());
}

TEST(Elimination, AveragesFitTheComponentsThatCount) {
  // For a face across x the displacements along x determine u_x and the rotations about y and z.
  Parts p;
  const auto face = p.face_x1();
  p.s.links.averages = {
      {"mean", p.near, face, {1, 1, 1, 1}, {true, false, false, false, true, true}, {}}};
  p.s.links.averages[0].components.assign(4, {true, false, false});
  p.s.links.rigid = {Parts::rigid(p.near, {p.hub})};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  // The plane through the displacements that leaves the least squares, on a face of 0.3 by 0.2.
  const Vector near = moved(fe, e, p.near);
  const Vector3d at = fe.nodes[static_cast<std::size_t>(p.near)].position;
  double mean = 0, about_y = 0, about_z = 0;
  for (const int node : face) {
    const Vector3d r = fe.nodes[static_cast<std::size_t>(node)].position - Vector3d(0.4, 0.15, 0.1);
    const double u = moved(fe, e, node)[0];
    mean += u / 4;
    about_y += u * r.z() / (4 * 0.1 * 0.1);
    about_z -= u * r.y() / (4 * 0.15 * 0.15);
  }
  EXPECT_NEAR(near[4], about_y, 1e-10);
  EXPECT_NEAR(near[5], about_z, 1e-10);
  EXPECT_NEAR(near[0], mean + about_y * (at.z() - 0.1) - about_z * (at.y() - 0.15), 1e-10);

  p.s.links.averages[0].variables.fill(true);
  const auto all = [&] { eliminate(fe.nodes, fe.dofs, p.s.links); };
  EXPECT_THAT(all,
              ThrowsMessage<ModelError>(AllOf(HasSubstr("mean: the chosen displacements"),
                                              HasSubstr("displacement along y of node \"near\""))));
}

TEST(Elimination, SolvesEquationsThatLetRigidMotionBe) {
  Parts p;
  // far moves along x as near does plus the lever of its rotations: 0.2 along y, −0.05 along z.
  // Rounding of the levers is corrected.
  p.s.links.equations = {{"equation",
                          {{p.far, 0, 2.0},
                           {p.near, 0, -2.0},
                           {p.near, 4, -2.0 * -0.0500003},
                           {p.near, 5, 2.0 * 0.2}}}};
  p.s.links.rigid = {Parts::rigid(p.near, p.face_x1()), Parts::rigid(p.near, {p.hub})};
  const FeModel fe = assemble(p.s);
  const Elimination e = eliminate(fe.nodes, fe.dofs, p.s.links);
  expect_rigid_motion(fe, e);
  EXPECT_EQ(e.dofs.node_dofs[static_cast<std::size_t>(p.far)][0], -1);
}

TEST(Elimination, RefusesWhatHoldsTheBodyOrDoesNotExist) {
  const auto with = [](const LinearEquation& equation) {
    return [equation] {
      Parts p;
      p.s.links.rigid = {Parts::rigid(p.near, p.face_x1()), Parts::rigid(p.near, {p.hub})};
      p.s.links.equations = {equation};
      const FeModel fe = assemble(p.s);
      eliminate(fe.nodes, fe.dofs, p.s.links);
    };
  };
  const Parts p;
  EXPECT_THAT(with({"deck.inp:7: equation", {{p.far, 2, 1.0}}}),
              ThrowsMessage<ModelError>(AllOf(HasSubstr("deck.inp:7: equation"),
                                              HasSubstr("holds the body against rigid"))));
  // No lever: the equation would block a rotation of the body.
  EXPECT_THAT(with({"equation", {{p.far, 0, 1.0}, {p.near, 0, -1.0}}}),
              ThrowsMessage<ModelError>(HasSubstr("rigid rotation about")));
  EXPECT_THAT(with({"equation", {{p.block, 4, 1.0}, {p.near, 4, -1.0}}}),
              ThrowsMessage<ModelError>(HasSubstr("has no variable rotation y")));
  EXPECT_THAT(with({"equation", {{p.far, 4, 0.0}}}),
              ThrowsMessage<ModelError>(HasSubstr("remove")));
  const auto average_of_two = [] {
    Parts q;
    q.s.links.rigid = {Parts::rigid(q.near, {q.hub})};
    q.s.links.averages = {Parts::average(q.near, {q.block, q.block + 1}, {1, 1})};
    q.s.links.averages[0].label = "deck.inp:9: average";
    const FeModel fe = assemble(q.s);
    eliminate(fe.nodes, fe.dofs, q.s.links);
  };
  EXPECT_THAT(average_of_two, ThrowsMessage<ModelError>(AllOf(HasSubstr("deck.inp:9: average"),
                                                              HasSubstr("on one line"))));
}

TEST(NodeSprings, StrainNoRigidMotionAndJoinNodes) {
  Parts p;
  SpringBlock::Stiffness k = SpringBlock::Stiffness::Zero();
  k.diagonal() << 1e6, 2e6, 3e6, 10, 20, 30;
  k(0, 4) = k(4, 0) = 1e3;
  p.s.links.rigid = {Parts::rigid(p.hub, p.face_x1())};
  p.s.springs.add(p.hub, p.near, k);
  const FeModel fe = assemble(p.s);
  const Matrix Q = test::rigid_motions(fe);
  EXPECT_LE((fe.K * Q).norm(), 1e-14 * fe.K.whole().norm() * Q.norm());
  // Between nodes at one place it is the stiffness itself.
  Parts same;
  const int twin =
      add_node(same.s, "twin", same.s.nodes[static_cast<std::size_t>(same.far)].position);
  same.s.links.rigid = {Parts::rigid(twin, same.face_x1()), Parts::rigid(same.near, {same.hub})};
  same.s.springs.add(same.far, twin, k);
  const FeModel two = assemble(same.s);
  const int first = two.dofs.node_dofs[static_cast<std::size_t>(twin)][0];
  const Matrix block = Matrix(two.K.whole()).block(first, first, 6, 6);
  EXPECT_LE((block - Matrix(k)).norm(), 1e-12 * k.norm());
}

TEST(NodeSprings, RefuseWhatCannotBe) {
  const auto with = [](auto&& change) {
    return [change] {
      Parts p;
      p.s.links.rigid = {Parts::rigid(p.hub, p.face_x1()), Parts::rigid(p.hub, {p.near})};
      change(p);
      assemble(p.s);
    };
  };
  const SpringBlock::Stiffness unit = SpringBlock::Stiffness::Identity();
  EXPECT_THAT(with([&](Parts& p) { p.s.springs.add(p.far, p.far, unit); }),
              ThrowsMessage<ModelError>(HasSubstr("both ends are the same node")));
  EXPECT_THAT(with([&](Parts& p) { p.s.springs.add(p.far, p.near, -unit); }),
              ThrowsMessage<ModelError>(HasSubstr("without negative eigenvalues")));
  EXPECT_THAT(with([&](Parts& p) { p.s.springs.add(p.block, p.near, unit); }),
              ThrowsMessage<ModelError>(HasSubstr("has no rotations")));
}

}  // namespace
}  // namespace buckens::fem
