// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/model/test/described.h"

namespace buckens::model {
namespace {

using Eigen::Vector3d;
using test::constant_law;
using test::Described;

const Vector3d kLoadedSize(0.4, 0.2, 0.1);

loads::BodyPart part(const std::string& text) { return {test::at_line(61), text}; }

void press(Described& m, const std::string& on, double value) {
  auto& kind = m.load<loads::PressureSpec>("gas");
  kind.on = part(on);
  kind.value = base::TimeLaw::constant(value);
}

void pull(Described& m, const std::string& on, const Vector3d& value,
          loads::LoadAxes axes = loads::LoadAxes::fixed) {
  auto& kind = m.load<loads::TractionSpec>("wind");
  kind.on = part(on);
  kind.value = constant_law(value);
  kind.axes = axes;
}

Described loaded_block(fem::SolidKind kind = fem::SolidKind::hex8) {
  Described m;
  auto& spec = std::get<fem::MeshSpec>(m.block("block", kLoadedSize, {3, 2, 2}).kind);
  auto& box = std::get<fem::BoxMeshSpec>(spec.shape);
  box.element = kind;
  box.integration.reset();
  return m;
}

/// Force and torque about the mass centre of all loads, bodies placed with the axes of the world.
spatial::Wrench resultant(const Model& model) {
  spatial::Wrench sum{Vector3d::Zero(), Vector3d::Zero()};
  for (const Load& load : model.loads) {
    const auto b = static_cast<std::size_t>(load.first.body);
    const Vector3d at = model.bodies[b].markers[static_cast<std::size_t>(load.first.marker)].X_BF.p;
    spatial::MarkerMotion motion;
    motion.p = at;
    motion.R.setIdentity();
    motion.v = motion.w = Vector3d::Zero();
    const spatial::Wrench own = load.element->evaluate(0, motion, motion).on_first;
    const Vector3d whole = model.bodies[b].com - model.wholes[0].com;
    sum.force += own.force;
    sum.torque += own.torque + (at + whole).cross(own.force);
  }
  return sum;
}

/// The nodal forces that a load puts on one body.
linalg::Vector nodal_forces(const Model& model, const Load& load) {
  const body::Body& body = model.bodies[static_cast<std::size_t>(load.first.body)];
  const auto& marker = body.markers[static_cast<std::size_t>(load.first.marker)];
  spatial::MarkerMotion motion;
  motion.p = marker.X_BF.p;
  motion.R.setIdentity();
  motion.v = motion.w = Vector3d::Zero();
  const loads::Action action = load.element->evaluate(0, motion, motion);
  linalg::Vector y = linalg::Vector::Zero(body.num_rows());
  if (marker.follows_mesh()) y.segment<3>(marker.translation_row) = action.on_first.force;
  if (load.pattern_row >= 0) y[load.pattern_row] = action.along_pattern;
  return body.flexible->rows.transpose() * y;
}

/// The virtual work of the nodal forces on rigid motions is that of the resultant on the frame.
void expect_rigid_work(const Described& m, const std::string& what) {
  SCOPED_TRACE(what);
  const auto built = m.build();
  const Model& model = built->model;
  ASSERT_EQ(model.loads.size(), 1U);
  const body::Body& body = model.bodies[0];
  std::vector<Vector3d> places;
  for (const fem::Node& node : body.flexible->mesh().nodes) places.push_back(node.position);
  const linalg::Matrix Phi = body::rigid_modes(places, body.flexible->mesh().dofs, body.com);
  const linalg::Vector work = Phi.transpose() * nodal_forces(model, model.loads[0]);
  const spatial::Wrench sum = resultant(model);
  const double size = model.loads[0].region->extent;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(work[k], sum.force[k], 1e-13 * size) << k;
    EXPECT_NEAR(work[3 + k], sum.torque[k], 1e-13 * size) << k;
  }
}

TEST(DistributedLoads, NodalForcesHaveTheResultantOnTheFrame) {
  for (const fem::SolidKind kind :
       {fem::SolidKind::hex8, fem::SolidKind::hex20, fem::SolidKind::tet4, fem::SolidKind::tet10}) {
    const char* name = choice_names(kind)[static_cast<std::size_t>(kind)];
    Described pressed = loaded_block(kind);
    press(pressed, "block/y1", 1.0);
    expect_rigid_work(pressed, name);
    Described pulled = loaded_block(kind);
    pull(pulled, "block/z0", {0.3, -0.5, 0.7});
    expect_rigid_work(pulled, name);
    Described heavy = loaded_block(kind);
    auto& weight = heavy.load<loads::BodyForceSpec>("weight");
    weight.on = part("block");
    weight.per_volume = constant_law({1, 2, 3});
    expect_rigid_work(heavy, name);
  }
  for (const fem::BeamTheory theory :
       {fem::BeamTheory::euler_bernoulli, fem::BeamTheory::timoshenko}) {
    Described m;
    auto& beam = m.beam("beam", {0, 0.1, 0}, {0.5, 0.3, 0.4}, 3);
    std::get<fem::BeamSpec>(beam.kind).theory = theory;
    auto& snow = m.load<loads::LineLoadSpec>("snow");
    snow.on = part("beam");
    snow.value = constant_law({0.2, -1, 0.4});
    expect_rigid_work(m, "beam");
  }
}

TEST(DistributedLoads, ResultantsOfABlock) {
  Described pressed = loaded_block();
  press(pressed, "block/x1", 2.0);
  const auto built = pressed.build();
  const Load& load = built->model.loads.at(0);
  EXPECT_NEAR(load.region->extent, 0.02, 1e-15);
  EXPECT_EQ(load.region->unit, "m^2");
  EXPECT_NEAR((load.region->at - Vector3d(0.2, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(load.region->feet.size(), 4U);
  EXPECT_NEAR((load.region->feet[0].normal - Vector3d(-1, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((resultant(built->model).force - Vector3d(-0.04, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(resultant(built->model).torque.norm(), 0, 1e-15);

  Described pulled = loaded_block();
  pull(pulled, "block/x1", {0, 5, 0});
  const spatial::Wrench sum = resultant(pulled.build()->model);
  EXPECT_NEAR((sum.force - Vector3d(0, 0.1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((sum.torque - Vector3d(0, 0, 0.02)).norm(), 0, 1e-15);
}

TEST(DistributedLoads, PartsOfADividedBodyShareThem) {
  for (const int frames : {1, 3}) {
    Described m = loaded_block();
    m.d.bodies[0].frames = body::FrameDivision(frames);
    press(m, "block/z1", 3.0);
    pull(m, "block/y0", {1, 2, -1});
    auto& weight = m.load<loads::BodyForceSpec>("weight");
    weight.on = part("block");
    weight.per_mass = constant_law({0, 0, -9.81});
    const auto built = m.build();
    const Model& model = built->model;
    EXPECT_LE(model.loads.size(), 3U * static_cast<std::size_t>(frames));
    EXPECT_EQ(model.loads.size() > 3U, frames > 1) << "parts that touch a face take a share";
    const double mass = model.wholes[0].mass;
    const Vector3d force =
        3.0 * 0.08 * Vector3d(0, 0, -1) + 0.04 * Vector3d(1, 2, -1) + mass * Vector3d(0, 0, -9.81);
    const Vector3d torque = Vector3d(0, -0.1, 0).cross(0.04 * Vector3d(1, 2, -1));
    EXPECT_NEAR((resultant(model).force - force).norm(), 0, 1e-12 * force.norm()) << frames;
    EXPECT_NEAR((resultant(model).torque - torque).norm(), 0, 1e-11) << frames;
  }
}

TEST(DistributedLoads, AUniformAccelerationNeedsNoRows) {
  Described m = loaded_block();
  m.rigid("stone", 2.0, Vector3d::Zero(), {1, 1, 1});
  auto& weight = m.load<loads::BodyForceSpec>("weight");
  weight.on = part("block");
  weight.per_mass = constant_law({0, 0, -9.81});
  auto& shake = m.load<loads::BaseAccelerationSpec>("shake");
  shake.value = constant_law({1, 0, 0});
  const auto built = m.build();
  EXPECT_EQ(built->model.bodies[0].num_interface_rows(), 0);
  ASSERT_EQ(built->model.loads.size(), 3U);
  const Vector3d on_stone =
      built->model.loads[2].element->evaluate(0, spatial::MarkerMotion{}, {}).on_first.force;
  EXPECT_NEAR((on_stone - Vector3d(-2, 0, 0)).norm(), 0, 1e-15);
}

TEST(DistributedLoads, PatternsStandBehindTheRowsOfJointsAndMarkers) {
  Described m = loaded_block();
  press(m, "block/x1", 1.0);
  pull(m, "block/x1", {1, 0, 0});
  m.force("push", "block/corner_000", {1, 0, 0});
  const auto built = m.build();
  const body::FlexiblePart& mesh = *built->model.bodies[0].flexible;
  EXPECT_EQ(mesh.num_interface_rows, 7);
  EXPECT_EQ(mesh.num_held_rows(), 3);
  EXPECT_EQ(built->model.loads[1].pattern_row, 3);
}

TEST(DistributedLoads, FacesComeFromInterfacesToo) {
  Described m = loaded_block();
  fem::PlaneSelection plane;
  plane.point = {0, 0.2, 0};
  plane.normal = {0, 1, 0};
  body::InterfaceSpec top;
  top.name = "top";
  top.region = plane;
  m.d.bodies[0].interfaces = {top};
  press(m, "block/top", 1.0);
  const auto built = m.build();
  EXPECT_NEAR((resultant(built->model).force - Vector3d(0, -0.04, 0)).norm(), 0, 1e-15);

  fem::BoxSelection all;
  all.to = kLoadedSize;
  m.d.bodies[0].interfaces[0].region = all;
  const auto skin = m.build();
  EXPECT_NEAR(skin->model.loads[0].region->extent, 2 * (0.08 + 0.04 + 0.02), 1e-14);
  EXPECT_NEAR(resultant(skin->model).force.norm(), 0, 1e-16) << "closed surface";
  EXPECT_NEAR(resultant(skin->model).torque.norm(), 0, 1e-16);
}

/// The message of the error when the model is built.
void expect_refused(const Described& m, const std::vector<std::string>& words) {
  try {
    m.build();
    FAIL() << "no error; expected were words such as " << words.front();
  } catch (const Error& error) {
    for (const std::string& word : words) EXPECT_THAT(error.what(), testing::HasSubstr(word));
  }
}

TEST(DistributedLoads, SayWhatIsWrong) {
  Described face = loaded_block();
  press(face, "block/x2", 1);
  expect_refused(face, {"test.yaml:61:1", "load \"gas\"", "no face \"x2\"", "Did you mean"});
  Described whole = loaded_block();
  press(whole, "block", 1);
  expect_refused(whole, {"a face is needed", "block/x0"});
  Described body = loaded_block();
  press(body, "blok/x1", 1);
  expect_refused(body, {"no body \"blok\"", "block"});
  Described rigid;
  rigid.rigid("stone", 1, Vector3d::Zero(), {1, 1, 1});
  press(rigid, "stone/x1", 1);
  expect_refused(rigid, {"\"stone\" is rigid", "pressure", "body-force"});
  Described beam;
  beam.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  press(beam, "rod", 1);
  expect_refused(beam, {"no faces", "line-load"});
  Described solid = loaded_block();
  solid.load<loads::LineLoadSpec>("snow").on = part("block");
  expect_refused(solid, {"no beams or bars", "traction"});
  Described set = loaded_block();
  auto& force = set.load<loads::BodyForceSpec>("mag");
  force.on = part("block/core");
  force.per_volume = constant_law({1, 0, 0});
  expect_refused(set, {"no element set \"core\""});
  Described number;
  number.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  number.load<loads::LineLoadSpec>("snow").on = part("rod/2");
  expect_refused(number, {"no beam \"2\"", "from 1 to 1"});
  Described plane = loaded_block();
  plane.d.planar = spatial::Plane::xy;
  pull(plane, "block/x1", {0, 0, 1});
  expect_refused(plane, {"planar", "component z"});
}

}  // namespace
}  // namespace buckens::model
