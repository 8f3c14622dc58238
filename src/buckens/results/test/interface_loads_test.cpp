// SPDX-License-Identifier: Apache-2.0
// Forces on a body place by place, against the generalised forces of the equations of motion.
#include "buckens/results/interface_loads.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/model/whole_body.h"
#include "buckens/results/field_recorder.h"
#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results::test {
namespace {

using Eigen::Vector3d;
using linalg::Vector;
using model::test::at_line;
using model::test::at_marker;
using model::test::constant_law;
using model::test::Described;
using testing::ElementsAre;

constexpr double kGravity = 9.81;

/// Asks for the loads on bodies, or on those places alone.
void ask_for_loads(Described& m, const std::vector<std::string>& on) {
  m.d.output.field_output.emplace();
  m.d.output.field_output->where = at_line(80);
  m.d.output.field_output->record = {model::FieldQuantity::interface_load};
  m.d.output.field_output->on = on;
}

Vector multipliers_of(const model::Model& model) {
  Vector out(model.num_constraint_rows());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    out[k] = 30 * std::sin(1.0 + 2.3 * static_cast<double>(k));
  }
  return out;
}

/// A model with its interface loads at one state.
struct Loaded {
  std::unique_ptr<model::BuiltModel> built;
  FieldRecorder recorder;
  model::State state;
  Record last;

  explicit Loaded(const Described& described)
      : built(described.build()), recorder(*built), state(model::placed_state(built->model)) {
    state.lambda = multipliers_of(built->model);
  }
  const model::Model& model() const { return built->model; }

  void record(double load_factor = 1.0, const Vector* lambda = nullptr) {
    last = recorder.record(state, {{}, lambda, load_factor});
  }
  std::vector<std::string> paths() const {
    std::vector<std::string> out;
    for (const Channel& channel : recorder.layout().fields.channels()) out.push_back(channel.path);
    return out;
  }
  spatial::Wrench wrench(const std::string& path) const {
    const RecordLayout& layout = recorder.layout().fields;
    const auto k = static_cast<std::size_t>(layout.find(path));
    const double* values = last.values.data() + layout.offset(k);
    return {Eigen::Map<const Vector3d>(values + 3), Eigen::Map<const Vector3d>(values)};
  }
  const model::WholeBody& whole(const std::string& name) const {
    return model().wholes[static_cast<std::size_t>(model().find_whole(name))];
  }
  Vector3d origin(const std::string& body) const {
    return model::whole_motion(model(), whole(body), state).X_WB.p;
  }
  Vector3d place(const std::string& body, const std::string& marker) const {
    const auto motions = dynamics::motions_of(model(), state);
    const model::WholeBody& own = whole(body);
    for (int b = own.first; b < own.first + own.count; ++b) {
      model::MarkerId id;
      id.body = b;
      id.marker = model().bodies[static_cast<std::size_t>(b)].find_marker(marker);
      if (id.marker >= 0) return dynamics::evaluate_marker(model(), id, motions).motion.p;
    }
    throw std::out_of_range(marker);
  }
  /// All that was recorded on a body, about the origin of its frame.
  spatial::Wrench recorded_sum(const std::string& body) const {
    const std::string interfaces = "fields/bodies/" + body + "/interfaces/";
    const std::string loads = "fields/bodies/" + body + "/loads/";
    spatial::Wrench sum;
    for (const std::string& path : paths()) {
      if (path.rfind(interfaces, 0) == 0) {
        spatial::Wrench one = wrench(path);
        one.torque += (place(body, path.substr(interfaces.size())) - origin(body)).cross(one.force);
        sum += one;
      } else if (path.rfind(loads, 0) == 0) {
        sum += wrench(path);
      }
    }
    return sum;
  }
  /// What the equations of motion of its frames have, without gravity.
  spatial::Wrench acting_sum(const std::string& body, double load_factor = 1.0) const {
    const auto motions = dynamics::motions_of(model(), state);
    dynamics::Forces forces;
    dynamics::evaluate_forces(model(), motions, state.t, forces, load_factor);
    dynamics::Constraints constraints;
    dynamics::evaluate_constraints(model(), motions, state.t, constraints);
    dynamics::add_joint_forces(constraints, state.lambda, forces);
    const model::WholeBody& own = whole(body);
    spatial::Wrench sum;
    for (int k = own.first; k < own.first + own.count; ++k) {
      const auto b = static_cast<std::size_t>(k);
      const spatial::Pose& X = state.bodies[b].frame.X_WB;
      const Vector3d force = forces.frame[b].tail<3>() - model().bodies[b].mass * model().gravity;
      sum.force += force;
      sum.torque += X.q * Vector3d(forces.frame[b].head<3>()) + (X.p - origin(body)).cross(force);
    }
    return sum;
  }
  void expect_all_is_there(const std::string& body, double load_factor = 1.0) const {
    const spatial::Wrench found = recorded_sum(body), expected = acting_sum(body, load_factor);
    ASSERT_GT(expected.force.norm(), 1.0);
    // Sums of some ten forces of 100 N at arms of 1 m.
    EXPECT_LT((found.force - expected.force).norm(), 1e-11);
    EXPECT_LT((found.torque - expected.torque).norm(), 1e-11);
  }
};

/// A beam of three frames on two partly redundant hinges about its length, with a
/// spring, a force, a torque and a load per length over all of its parts.
Described loaded_beam() {
  Described m;
  m.d.gravity = {0, 0, -kGravity};
  m.beam("rod", Vector3d::Zero(), Vector3d::UnitX(), 6).frames = 3;
  m.joint<joints::RevoluteSpec>("left", "ground", "rod/start").axis = Vector3d::UnitX();
  m.joint<joints::RevoluteSpec>("right", "rod/end", "ground").axis = Vector3d::UnitX();
  m.d.joints.back().where = at_line(51);
  std::get<joints::RevoluteSpec>(m.d.joints.back().kind).between[1].point = Vector3d::UnitX();
  auto& spring = m.load<loads::SpringDamperSpec>("spring");
  spring.between = {at_marker("ground"), at_marker("rod/end")};
  spring.between[0].point = Vector3d(1, 0.3, 0.4);
  spring.stiffness = 400;
  spring.damping = 3;
  spring.length = 0.2;
  m.force("push", "rod/mid", {3, -20, 40});
  m.torque("twist", "rod/end", {2, 1, -4});
  auto& load = m.load<loads::LineLoadSpec>("snow");
  load.on = {at_line(60), "rod"};
  load.value = constant_law({5, 12, -30});
  ask_for_loads(m, {});
  return m;
}

/// Moves and turns all parts together, with velocities.
void move_rigidly(Loaded& run) {
  const spatial::Pose X{{3, -2, 1}, spatial::exp_rotation(Vector3d(0.5, -1.0, 2.0))};
  const Vector3d w(0.7, -0.3, 1.1), v(2, 1, -1);
  for (model::BodyState& s : run.state.bodies) {
    s.frame.X_WB = X * s.frame.X_WB;
    s.frame.w = s.frame.X_WB.q.conjugate() * w;
    s.frame.v = v + w.cross(s.frame.X_WB.p);
  }
}

TEST(InterfaceLoads, OfADividedBodyAreAllThatActsOnItsPartsFromOutside) {
  Loaded run(loaded_beam());
  EXPECT_THAT(run.paths(), testing::UnorderedElementsAre("fields/bodies/rod/interfaces/start",
                                                         "fields/bodies/rod/interfaces/end",
                                                         "fields/bodies/rod/interfaces/mid",
                                                         "fields/bodies/rod/loads/snow"))
      << "cuts are no places";
  run.record();
  run.expect_all_is_there("rod");
  // Joints, springs and loads on deformed and moving bodies, away from their places.
  move_rigidly(run);
  run.record();
  run.expect_all_is_there("rod");
  // A load over all parts is one, its torque that about the mass centre of the whole.
  const spatial::Wrench snow = run.wrench("fields/bodies/rod/loads/snow");
  EXPECT_LT((snow.force - Vector3d(5, 12, -30)).norm(), 1e-12);
  EXPECT_LT(snow.torque.norm(), 1e-12);
}

TEST(InterfaceLoads, TheLoadFactorMultipliesAppliedLoadsOnly) {
  Loaded run(loaded_beam());
  run.record(1.0);
  const spatial::Wrench end = run.wrench("fields/bodies/rod/interfaces/end");
  run.record(2.5);
  run.expect_all_is_there("rod", 2.5);
  EXPECT_LT(
      (run.wrench("fields/bodies/rod/interfaces/mid").force - 2.5 * Vector3d(3, -20, 40)).norm(),
      1e-13);
  EXPECT_LT((run.wrench("fields/bodies/rod/interfaces/end").force - end.force).norm(), 1e-13)
      << "hinge and spring stay";
  EXPECT_LT((run.wrench("fields/bodies/rod/interfaces/end").torque - end.torque -
             1.5 * Vector3d(2, 1, -4))
                .norm(),
            1e-13);
}

TEST(InterfaceLoads, OfTheNamedPlacesOnly) {
  Described m = loaded_beam();
  ask_for_loads(m, {"rod/end"});
  const Loaded run(m);
  EXPECT_THAT(run.paths(), ElementsAre("fields/bodies/rod/interfaces/end"));
}

TEST(InterfaceLoads, OfPressureAndTractionOverAllPartsAreThoseOfTheWholeFace) {
  Described m;
  m.block("block", {0.4, 0.2, 0.1}, {4, 2, 1}).frames = 2;
  m.joint<joints::SphericalSpec>("pin", "ground", "block/corner_000");
  auto& pressure = m.load<loads::PressureSpec>("gas");
  pressure.on = {at_line(61), "block/z1"};
  pressure.value = base::TimeLaw::constant(2e3);
  auto& traction = m.load<loads::TractionSpec>("wind");
  traction.on = {at_line(62), "block/z1"};
  traction.value = constant_law({1e3, -2e3, 500});
  ask_for_loads(m, {"block"});
  Loaded run(m);
  run.record();
  run.expect_all_is_there("block");
  const Vector3d arm(0, 0, 0.05);  // of the middle of the face
  const double area = 0.08;
  const Vector3d pushed(0, 0, -2e3 * area), blown = area * Vector3d(1e3, -2e3, 500);
  const spatial::Wrench gas = run.wrench("fields/bodies/block/loads/gas");
  const spatial::Wrench wind = run.wrench("fields/bodies/block/loads/wind");
  EXPECT_LT((gas.force - pushed).norm(), 1e-11);
  EXPECT_LT((gas.torque - arm.cross(pushed)).norm(), 1e-12);
  EXPECT_LT((wind.force - blown).norm(), 1e-11);
  EXPECT_LT((wind.torque - arm.cross(blown)).norm(), 1e-12);
}

TEST(InterfaceLoads, OfRedundantJointsAreSharedAsTheirMultipliersAre) {
  // A door on two hinges: five of ten equations follow from the others. One hinge alone is said to
  // carry the door; multipliers of least norm give each its half.
  Described m;
  m.d.gravity = {0, 0, -kGravity};
  m.rigid("door", 20, {0.5, 0, 0}, {7, 8.4, 1.7});
  for (const double z : {-1.0, 1.0}) {
    const std::string name = z < 0 ? "lower" : "upper";
    m.d.bodies.back().markers.push_back(Described::marker(name, {0, 0, z}));
    auto& hinge = m.joint<joints::RevoluteSpec>(name, "ground", "door/" + name);
    hinge.axis = Vector3d::UnitZ();
    hinge.between[0].point = Vector3d(0, 0, z);
  }
  ask_for_loads(m, {"door"});
  Loaded run(m);
  const dynamics::MassMetric metric(run.model());
  Recorder recorder(*run.built, metric, true);
  run.state.lambda.setZero();
  run.state.lambda[2] = 20 * kGravity;  // rows of a hinge: x, y, z, then two torques
  run.state.lambda[3] = 7;
  run.record();
  const spatial::Wrench before = run.recorded_sum("door");
  EXPECT_LT((before.force - Vector3d(0, 0, 20 * kGravity)).norm(), 1e-12);
  EXPECT_EQ(run.wrench("fields/bodies/door/interfaces/upper").force.norm(), 0);
  run.expect_all_is_there("door");

  recorder.record(run.state, {});
  run.record(1.0, &recorder.last_multipliers());
  const spatial::Wrench after = run.recorded_sum("door");
  EXPECT_LT((after.force - before.force).norm(), 1e-10);
  EXPECT_LT((after.torque - before.torque).norm(), 1e-10);
  for (const char* name : {"lower", "upper"}) {
    const spatial::Wrench one = run.wrench(std::string("fields/bodies/door/interfaces/") + name);
    EXPECT_NEAR(one.force.z(), 10 * kGravity, 1e-9) << name;
  }
}

}  // namespace
}  // namespace buckens::results::test
