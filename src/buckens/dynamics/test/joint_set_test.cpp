// SPDX-License-Identifier: Apache-2.0
// Joints stored contiguously against the model's own evaluation of them.
#include "buckens/dynamics/joint_set.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/dynamics/row_blocks.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/joints/swing_twist.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/bristle_friction.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/spatial/rotation.h"

namespace buckens::dynamics {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using joints::JointType;
using linalg::Vector;

double any_number(int k) { return std::sin(0.4 + 1.9 * k + 0.03 * k * k); }

/// Every kind of joint, in space: between rigid bodies, nodes with rotations, nodes without,
/// ground.
model::Model all_joints() {
  test::Mechanism m;
  test::BeamConstants beam;
  beam.elements = 2;
  fem::Structure solid;
  fem::Box box;
  box.size = {0.3, 0.1, 0.1};
  box.divisions = {2, 1, 1};
  fem::add_box(solid, box, fem::Material::isotropic(1e8, 0.3, 1100));
  const Eigen::Quaterniond turned = spatial::exp_rotation(Vector3d(0.3, -0.2, 0.5));
  const int rigid = m.add_rigid(2.0, Eigen::Matrix3d::Identity(), {{0.2, 0.1, 0}, turned});
  const int rod = m.add_flexible(test::straight_beam(beam), {}, {{1, 0, 0.2}, turned});
  const int block = m.add_flexible(fem::assemble(solid), {}, {{0, 2, 0}, turned});
  const auto angle = base::TimeLaw::expression(base::Expression("2*t+0.3", {"t"}, {}, {}));
  const auto way = base::TimeLaw::expression(base::Expression("t^2+0.1", {"t"}, {}, {}));
  const auto on_rigid = m.rigid_marker(rigid, {0.1, 0.2, 0.3}, turned);
  const Vector3d axis(0.2, -0.5, 0.8);
  m.add_joint(JointType::revolute, test::Mechanism::ground({0.1, 0, 0}), on_rigid, axis);
  m.add_joint(JointType::prescribed_rotation, test::Mechanism::ground({0.1, 0, 0}), on_rigid, axis,
              angle);
  m.add_joint(JointType::fixed, m.node_marker(rod, 0), on_rigid);
  m.add_joint(JointType::prismatic, on_rigid, m.node_marker(rod, 2), axis);
  m.add_joint(JointType::prescribed_translation, m.node_marker(rod, 1), on_rigid, axis, way);
  m.add_joint(JointType::spherical, m.node_marker(block, 3), m.node_marker(rod, 2));
  m.add_joint(JointType::prescribed_translation, m.node_marker(block, 5),
              test::Mechanism::ground({0, 2, 0}), axis, way);
  m.add_joint(JointType::fixed, m.node_marker(rod, 1), m.node_marker(rod, 2));  // of one body
  m.add_joint(JointType::gear, m.node_marker(rod, 1), on_rigid, axis, std::nullopt,
              [](joints::Placement& placement) {
                placement.sizes = {17, 29};
                placement.pressure_angle = 0.3;
              });
  using Kind = joints::JointCoordinate::Kind;
  joints::CoordinateTerm curve;
  curve.function = joints::CoordinateFunction::polynomial({0.1, 0.2, -0.3});
  m.add_coupler({{m.add_coordinate(0, Kind::angle), {0.7, std::nullopt}},
                 {m.add_coordinate(3, Kind::displacement), curve},
                 {m.add_coordinate(5, Kind::displacement), {-1.3, std::nullopt}}});
  m.add_joint(JointType::spherical, test::Mechanism::ground({0.1, 0, 0}), on_rigid);  // behind it
  const auto swing = std::make_shared<joints::Swing>(Vector3d::UnitZ(), Vector3d::UnitX());
  m.add_coupler({{m.add_coordinate(10, joints::JointCoordinate::measured(swing)), {}}}, way);
  return m.take();
}

/// Bodies moved from their placement and deformed by arbitrary numbers.
std::vector<BodyMotion> any_motions(const model::Model& model) {
  std::vector<BodyMotion> out(model.bodies.size());
  int k = 0;
  const auto three = [&] {
    k += 3;
    return Vector3d(any_number(k), any_number(k + 1), any_number(k + 2));
  };
  for (std::size_t b = 0; b < out.size(); ++b) {
    out[b].frame.X_WB.p = model.placed[b].p + 0.2 * three();
    out[b].frame.X_WB.q = model.placed[b].q * spatial::exp_rotation(0.4 * three());
    out[b].frame.w = 3.0 * three();
    out[b].frame.v = 2.0 * three();
    out[b].y.resize(model.bodies[b].num_interface_rows());
    out[b].y_dot.resize(out[b].y.size());
    for (Eigen::Index i = 0; i < out[b].y.size(); ++i) {
      out[b].y[i] = 0.3 * any_number(++k);
      out[b].y_dot[i] = any_number(++k);
    }
  }
  return out;
}

/// Some turns, and a flank that carries.
model::RowMemory any_memory(const model::Model& model) {
  model::RowMemory out = model::placed_state(model).memory;
  out.coordinates[0].turns = 2;
  out.rows << -1, 0.1, 3, 0.2, -1;
  return out;
}

constexpr double kInstant = 0.37;
// Sums of a few products of numbers up to ten, in another order.
constexpr double kOrder = 1e-13;

TEST(JointSet, EvaluatesAsTheModelDoes) {
  const model::Model model = all_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  Constraints expected;
  const model::RowMemory memory = any_memory(model);
  evaluate_constraints(model, motions, kInstant, &memory, expected);
  Vector lambda(model.num_constraint_rows());
  for (int k = 0; k < static_cast<int>(lambda.size()); ++k) lambda[k] = any_number(7 * k);
  Forces by_model, by_set;
  for (Forces* forces : {&by_model, &by_set}) forces->reset(model);
  add_joint_forces(expected, lambda, by_model);

  const JointSet joints(model);
  JointResiduals found;
  joints.evaluate(motions, kInstant, &memory, found, &lambda, &by_set);
  ASSERT_EQ(found.g.size(), expected.g.size());
  EXPECT_LE((found.g - expected.g).cwiseAbs().maxCoeff(), kOrder);
  EXPECT_LE((found.g_dot - expected.g_dot).cwiseAbs().maxCoeff(), kOrder);
  EXPECT_LE((found.g_t - expected.g_t).cwiseAbs().maxCoeff(), kOrder);
  EXPECT_GT(expected.g_t.cwiseAbs().maxCoeff(), 0.1);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    EXPECT_GT(by_model.frame[b].norm(), 0.1);
    EXPECT_LE((by_set.frame[b] - by_model.frame[b]).norm(), kOrder) << b;
    EXPECT_LE((by_set.interface[b] - by_model.interface[b]).norm(), kOrder) << b;
  }
}

TEST(JointSet, DerivesAsTheModelDoes) {
  const model::Model model = all_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  Constraints expected;
  const model::RowMemory memory = any_memory(model);
  evaluate_constraints(model, motions, kInstant, &memory, expected);
  const JointSet joints(model);
  std::array<SystemRow, JointSet::kMostRows> rows;  // as of another joint before
  int count = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints.derivatives(j, motions, kInstant, &memory, rows);
    for (int k = 0; k < joints.num_rows(j); ++k, ++count) {
      ASSERT_EQ(joints.first_row(j) + k, count);
      const SystemRow& row = expected.rows[static_cast<std::size_t>(count)];
      const SystemRow& found = rows[static_cast<std::size_t>(k)];
      ASSERT_EQ(row.num_parts(), found.num_parts()) << count;
      for (std::size_t part = 0; part < row.num_parts(); ++part) {
        const BodyRow* const a = &row.part(part);
        const BodyRow* const b = &found.part(part);
        ASSERT_EQ(a->body, b->body) << count;
        if (a->body == model::kGround) continue;
        EXPECT_EQ(a->translation_row, b->translation_row);
        EXPECT_EQ(a->rotation_row, b->rotation_row);
        EXPECT_LE((a->frame - b->frame).norm(), kOrder) << count;
        if (a->translation_row < 0) continue;
        EXPECT_LE((a->interface - b->interface).head<3>().norm(), kOrder) << count;
        if (a->rotation_row < 0) continue;
        EXPECT_LE((a->interface - b->interface).tail<3>().norm(), kOrder) << count;
      }
    }
  }
  EXPECT_EQ(count, model.num_constraint_rows());
}

loads::FrictionData rubbing_pin() {
  loads::FrictionData out;
  out.static_coefficient = 0.3;
  out.dynamic_coefficient = 0.2;
  out.stribeck_rate = 0.5;
  out.viscous = 0.1;
  out.slip = 1e-2;
  out.inertia = 0.02;
  out.radius = 0.01;
  out.axial_radius = 0.03;
  return out;
}

/// Laws of every kind on joints, with other loads between them.
model::Model with_laws_on_joints() {
  test::Mechanism m;
  test::BeamConstants beam;
  beam.elements = 2;
  const Eigen::Quaterniond turned = spatial::exp_rotation(Vector3d(0.3, -0.2, 0.5));
  const int rigid = m.add_rigid(2.0, Eigen::Matrix3d::Identity(), {{0.2, 0.1, 0}, turned});
  const int rod = m.add_flexible(test::straight_beam(beam), {}, {{1, 0, 0.2}, turned});
  const auto on_rigid = m.rigid_marker(rigid, {0.1, 0.2, 0.3}, turned);
  const auto on_rod = m.node_marker(rod, 2);
  const Vector3d axis = Vector3d::UnitZ();
  const auto angle = joints::JointCoordinate::angle(axis, Eigen::Matrix3d::Identity());
  const auto spring = [&](double k) {
    m.add_load(std::make_unique<loads::SpringDamper>(k, 0.1, 0.2, std::nullopt), on_rigid, on_rod);
  };
  m.add_joint(JointType::revolute, test::Mechanism::ground({0.1, 0, 0}), on_rigid, axis);
  m.add_law(std::make_unique<loads::JointFriction>(rubbing_pin(), axis), angle);
  spring(3.0);
  m.add_law(std::make_unique<loads::CoordinateSpring>(2.0, 0.1, 0.0), angle);
  m.add_joint(JointType::revolute, m.node_marker(rod, 0), on_rigid, axis);
  m.add_law(std::make_unique<loads::RigidFriction>(rubbing_pin(), axis), angle);
  m.add_law(std::make_unique<loads::BristleFriction>(rubbing_pin(),
                                                     loads::BristleData{5.0, 0.1, 0.5}, axis),
            angle);
  spring(4.0);
  m.add_joint(JointType::spherical, on_rod, test::Mechanism::ground({1, 0, 1}));
  m.add_law_of_joint(std::make_unique<loads::BallFriction>(rubbing_pin(), std::nullopt));
  return m.take();
}

Vector any_multipliers(const model::Model& model) {
  Vector lambda(model.num_constraint_rows());
  for (int k = 0; k < static_cast<int>(lambda.size()); ++k) lambda[k] = 5.0 * any_number(7 * k);
  return lambda;
}

/// That of the placed model, its laws a little strained.
model::RowMemory strained_memory(const model::Model& model) {
  model::RowMemory memory = model::placed_state(model).memory;
  for (Eigen::Index k = 0; k < memory.laws.size(); ++k) memory.laws[k] += 0.001;
  return memory;
}

TEST(JointSet, LawsOnJointsActAsAloneSoFarAsTheyAreOn) {
  const model::Model model = with_laws_on_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  Vector lambda = any_multipliers(model);
  model::RowMemory memory = strained_memory(model);
  memory.laws[model.loads[3].first_state] = 3;  // the rigid one slides backwards
  const JointSet joints(model);
  EXPECT_EQ(std::count(joints.laws().begin(), joints.laws().end(), 1), 5);
  const auto check = [&](std::size_t turning) {
    const Circumstances around{nullptr, &memory, &lambda, nullptr, nullptr};
    Forces expected, found;
    JointResiduals residuals;
    evaluate_forces(model, motions, kInstant, around, expected);
    joints.evaluate(motions, kInstant, &memory, residuals, &lambda, &expected);
    evaluate_forces(model, motions, kInstant, around, found, 1.0, &joints.laws());
    EXPECT_GT((found.frame[0] - expected.frame[0]).norm(), 0.1);
    std::vector<ReactionSlope> slopes;
    const JointSet::Laws with{around, &slopes};
    joints.evaluate(motions, kInstant, &memory, residuals, &lambda, &found, &with);
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      EXPECT_LE((found.frame[b] - expected.frame[b]).norm(), 10 * kOrder) << b;
      EXPECT_LE((found.interface[b] - expected.interface[b]).norm(), 10 * kOrder) << b;
    }
    EXPECT_EQ(found.regimes, expected.regimes);
    EXPECT_EQ(
        std::count_if(found.regimes.begin(), found.regimes.end(), [](int r) { return r != 0; }),
        static_cast<std::ptrdiff_t>(turning));
    ASSERT_EQ(found.rigid.size(), 1U);
    EXPECT_NEAR(found.rigid[0].given, expected.rigid[0].given, kOrder);
    EXPECT_NEAR(found.stored_energy, expected.stored_energy, kOrder);
    EXPECT_NEAR(found.active_power, expected.active_power, 10 * kOrder);
    EXPECT_NEAR(found.dissipation, expected.dissipation, 10 * kOrder);
  };
  check(4);  // of a spring it is zero
  memory.off.assign(model.loads.size(), 0);
  memory.off[0] = 1;
  check(3);
  memory.released.assign(model.joints.size(), 0);
  // What acts on a joint that has let go acts on, without a reaction.
  memory.released[1] = 1;
  lambda.segment(model.joints[1].first_row, std::ssize(model.joints[1].rows)).setZero();
  check(3);  // bristles without a bound are bent at once
}

void expect_same(const BodyRow& found, const BodyRow& expected) {
  EXPECT_EQ(found.body, expected.body);
  EXPECT_EQ(found.translation_row, expected.translation_row);
  EXPECT_EQ(found.rotation_row, expected.rotation_row);
  EXPECT_LE((found.frame - expected.frame).norm(), kOrder);
  EXPECT_LE((found.interface - expected.interface).norm(), kOrder);
}

void expect_same(const SoftRows& found, const SoftRows& expected) {
  EXPECT_EQ(found.regimes, expected.regimes);
  EXPECT_EQ(found.rigid, expected.rigid);
  EXPECT_EQ(found.is_closed, expected.is_closed);
  ASSERT_EQ(found.rows.size(), expected.rows.size());
  for (std::size_t k = 0; k < found.rows.size(); ++k) {
    expect_same(found.rows[k].first, expected.rows[k].first);
    expect_same(found.rows[k].second, expected.rows[k].second);
    // Relative to themselves: friction is as stiff as its load over its slip.
    EXPECT_NEAR(found.stiffness[k], expected.stiffness[k], kOrder * (1 + expected.stiffness[k]));
    EXPECT_NEAR(found.damping[k], expected.damping[k], kOrder * (1 + expected.damping[k]));
  }
}

TEST(JointSet, LawsOnJointsGiveWayAsAlone) {
  const model::Model model = with_laws_on_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  const Vector lambda = any_multipliers(model);
  model::RowMemory memory = strained_memory(model);
  const JointSet joints(model);
  const ReactionSlopes followers(model);
  const Circumstances around{nullptr, &memory, &lambda, nullptr, nullptr};
  for (const bool is_one_off : {false, true}) {
    memory.off.assign(model.loads.size(), 0);
    memory.off[0] = is_one_off ? 1 : 0;
    SoftRows expected, found;
    std::vector<ReactionSlope> expected_slopes, slopes;
    evaluate_soft_rows(model, motions, kInstant, around, expected, &followers, &expected_slopes);
    evaluate_soft_rows(model, motions, kInstant, around, found, &followers, &slopes, &joints);
    expect_same(found, expected);
    EXPECT_GT(slopes.size(), 3U);
    ASSERT_EQ(slopes.size(), expected_slopes.size());
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      EXPECT_EQ(slopes[k].soft, expected_slopes[k].soft);
      EXPECT_EQ(slopes[k].row, expected_slopes[k].row);
      EXPECT_NEAR(slopes[k].value, expected_slopes[k].value, kOrder);
    }
  }
}

TEST(JointSet, TellsWhatLawsRememberIfTheStepEndsThere) {
  const model::Model model = with_laws_on_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  const Vector lambda = any_multipliers(model);
  model::RowMemory memory = strained_memory(model);
  memory.coordinates[0].turns = 2;
  const JointSet joints(model);
  const Circumstances around{nullptr, &memory, &lambda, nullptr, nullptr};
  for (const bool is_one_off : {false, true}) {
    memory.off.assign(model.loads.size(), 0);
    memory.off[0] = is_one_off ? 1 : 0;
    LawEnds ends;
    JointResiduals residuals;
    Forces forces;
    evaluate_forces(model, motions, kInstant, around, forces, 1.0, &joints.laws());
    const JointSet::Laws with{around, nullptr, nullptr, &ends};
    joints.evaluate(motions, kInstant, &memory, residuals, &lambda, &forces, &with);
    // Rigid friction, bristles and balls have more states than one.
    for (std::size_t k = 0; k < model.loads.size(); ++k) {
      EXPECT_EQ(ends.knows_law(k), k == 0 && !is_one_off) << k;
    }
    model::RowMemory expected, found;
    advance_memory(model, motions, kInstant, around, expected);
    advance_memory(model, motions, kInstant, around, found, &ends);
    for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
      EXPECT_EQ(found.coordinates[k].turns, expected.coordinates[k].turns) << k;
      EXPECT_NEAR(found.coordinates[k].fraction, expected.coordinates[k].fraction, kOrder) << k;
    }
    ASSERT_EQ(found.laws.size(), expected.laws.size());
    EXPECT_LE((found.laws - expected.laws).cwiseAbs().maxCoeff(), kOrder);
    if (is_one_off) continue;
    ends.laws[0].state = 0.125;  // it is not evaluated again
    advance_memory(model, motions, kInstant, around, found, &ends);
    EXPECT_EQ(found.laws[model.loads[0].first_state], 0.125);
  }
}

TEST(RowBlocks, RowsBetweenTheSameMarkersAreOneBlock) {
  const model::Model model = all_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  Constraints constraints;
  evaluate_constraints(model, motions, kInstant, constraints);
  // A row of the prismatic joint once more, behind all others, as laws on its coordinate are.
  const int like = model.joints[3].first_row;
  std::vector<SystemRow> rows = constraints.rows;
  const RowBlocks plain(rows);
  rows.push_back(rows[static_cast<std::size_t>(like)]);
  const RowBlocks with_law(rows);
  EXPECT_EQ(with_law.blocks().size(), plain.blocks().size());
  const int last = with_law.num_rows() - 1;
  const int block = with_law.block_of(last);
  EXPECT_EQ(block, with_law.block_of(like));
  EXPECT_EQ(with_law.number_in_block(last), 5);
  EXPECT_EQ(with_law.blocks()[static_cast<std::size_t>(block)].rows[5], last);
  // Those that are left out of the factor stay by themselves.
  const RowBlocks behind(rows, 1);
  EXPECT_EQ(behind.blocks().size(), plain.blocks().size() + 1);
  EXPECT_EQ(behind.blocks().back().rows[0], last);
}

TEST(RowBlocks, GatherAndChangeAsTheRowsThemselvesDo) {
  const model::Model model = all_joints();
  const std::vector<BodyMotion> motions = any_motions(model);
  Constraints constraints;
  evaluate_constraints(model, motions, kInstant, constraints);
  // One more along the first, but in another place.
  constraints.rows.push_back(constraints.rows[0]);
  for (Vector* values : {&constraints.g_dot, &constraints.g_t}) {
    values->conservativeResize(values->size() + 1);
    values->tail(1) = values->head(1);
  }
  RowBlocks blocks(constraints.rows);
  EXPECT_EQ(blocks.num_rows(), model.num_constraint_rows() + 1);
  EXPECT_LT(blocks.blocks().size(), constraints.rows.size());
  for (int r = 0; r < blocks.num_rows(); ++r) {
    blocks.set(r, constraints.rows[static_cast<std::size_t>(r)]);
  }
  Vector x(blocks.num_rows());
  for (int k = 0; k < blocks.num_rows(); ++k) x[k] = any_number(5 * k);
  Forces expected;
  expected.reset(model);
  add_joint_forces(constraints, x, expected);
  std::vector<BodyResponse> found(model.bodies.size());
  for (std::size_t b = 0; b < found.size(); ++b) {
    found[b].interface_load.setZero(model.bodies[b].num_interface_rows());
  }
  blocks.gather(x, found);
  for (std::size_t b = 0; b < found.size(); ++b) {
    EXPECT_LE((found[b].frame_load - expected.frame[b]).norm(), kOrder) << b;
    EXPECT_LE((found[b].interface_load - expected.interface[b]).norm(), kOrder) << b;
  }
  // Along the rates the rows change by ġ without its explicit part.
  std::vector<Eigen::Matrix<double, 6, 1>> u;
  for (const BodyMotion& motion : motions) {
    u.emplace_back() << motion.frame.w, motion.frame.v;
  }
  Vector changes;
  blocks.changes(changes, [&](int b) {
    const auto k = static_cast<std::size_t>(b);
    return Displacement{&u[k], &motions[k].y_dot};
  });
  EXPECT_LE((changes - (constraints.g_dot - constraints.g_t)).cwiseAbs().maxCoeff(), kOrder);
  // A row that is cleared does nothing, and others of its block are as before.
  blocks.clear(1);
  EXPECT_TRUE(blocks.is_empty(1));
  EXPECT_FALSE(blocks.is_empty(0));
  Vector cleared;
  blocks.changes(cleared, [&](int b) {
    const auto k = static_cast<std::size_t>(b);
    return Displacement{&u[k], &motions[k].y_dot};
  });
  changes[1] = 0.0;
  EXPECT_EQ(cleared, changes);
}

}  // namespace
}  // namespace buckens::dynamics
