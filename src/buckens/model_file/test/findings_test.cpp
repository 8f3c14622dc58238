// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/check/check_description.h"
#include "buckens/model_file/model_file.h"

namespace buckens::model_file {
namespace {

constexpr const char* kModel = R"(buckens: 1
planar: xy
materials:
  steel: {E: 200e9, nu: 0.3, rho: 7850}
sections:
  pipe: {tube: {outer-diameter: 0.04, thickness: 0.003}}
bodies:
  crank: {rigid: {mass: 2, inertia: [1, 2, 2.5]}, markers: {pin: {position: [0.1, 0, 0]}}}
  rod:
    beam: {from: [0.1, 0, 0], to: [1, 0, 0], elements: 4, section: pipe, material: steel}
joints:
  hinge: {revolute: {between: [ground, crank/origin]}}
  pin: {revolute: {between: [crank/pin, rod/start]}}
loads:
  weight: {force: {on: rod/end, value: [0, -1, 0]}}
initial: {bodies: {crank: {angular-velocity: [0, 0, 1]}}}
simulation: {duration: 1, step: 0.01}
output:
  sensors:
    bend: {deflection: {of: rod/mid}}
)";

/// One fault, written into the text of the model and done to the description by a program.
struct Fault {
  const char *from, *to;  ///< in the text
  std::function<void(model::ModelDescription&)> in_code;
  const char* words;  ///< how the message begins
};

template <class Kind>
Kind& kind_of(model::ModelDescription& d, std::size_t body) {
  return std::get<Kind>(d.bodies.at(body).kind);
}

std::vector<Fault> faults_of_bodies() {
  using model::ModelDescription;
  return {
      {"to: [1, 0, 0]", "to: [0.1, 0, 0]",
       [](ModelDescription& d) {
         auto& beam = kind_of<fem::BeamSpec>(d, 1);
         beam.to = beam.from;
       },
       "bodies.rod.beam.to: the beam has zero length"},
      {"inertia: [1, 2, 2.5]", "inertia: [1, 2, 25]",
       [](ModelDescription& d) {
         kind_of<body::RigidSpec>(d, 0).inertia = {1, 2, 25};
       },
       "bodies.crank.rigid.inertia: the principal moments 1, 2, 25"},
      {"mass: 2", "mass: -2", [](ModelDescription& d) { kind_of<body::RigidSpec>(d, 0).mass = -2; },
       "bodies.crank.rigid.mass: -2 is not allowed: the value must not be negative"},
      {"elements: 4", "elements: 0",
       [](ModelDescription& d) { kind_of<fem::BeamSpec>(d, 1).elements = 0; },
       "bodies.rod.beam.elements: 0 is not allowed: the value must be positive"},
      {"thickness: 0.003", "thickness: 0.03",
       [](ModelDescription& d) {
         std::get<fem::TubeSpec>(d.sections.at(0).shape).thickness = 0.03;
       },
       "sections.pipe.tube.thickness: the inner diameter would be -0.02 m"},
      {"nu: 0.3", "nu: 0.7", [](ModelDescription& d) { d.materials.at(0).nu = 0.7; },
       "materials.steel.nu: 0.7 is not allowed: the value must lie between -1 and 0.5"},
  };
}

std::vector<Fault> faults_between_bodies() {
  using model::ModelDescription;
  return {
      {"crank/origin", "crank/orign",
       [](ModelDescription& d) {
         std::get<joints::RevoluteSpec>(d.joints.at(0).kind).between[1].marker = "orign";
       },
       "joints.hinge.revolute.between.1: body \"crank\" has no marker \"orign\". Did you mean"},
      {"[crank/pin, rod/start]", "[crank/pin, crank/origin]",
       [](ModelDescription& d) {
         auto& between = std::get<joints::RevoluteSpec>(d.joints.at(1).kind).between;
         between[1].body = "crank";
         between[1].marker = "origin";
         between[1].text = "crank/origin";
       },
       "joints.pin.revolute.between: \"crank/pin\" and \"crank/origin\" are on the same body"},
      {"on: rod/end", "on: ground",
       [](ModelDescription& d) {
         auto& on = std::get<loads::ForceSpec>(d.loads.at(0).kind).on;
         on.body = "ground";
         on.marker.clear();
       },
       "loads.weight.force.on: a load on the ground has no effect"},
      {"{crank: {angular", "{crnk: {angular",
       [](ModelDescription& d) { d.initial.bodies.at(0).name = "crnk"; },
       "initial.bodies.crnk: unknown body \"crnk\". Did you mean \"crank\"?"},
      {"pin: {position", "com: {position",
       [](ModelDescription& d) { d.bodies.at(0).markers.at(0).name = "com"; },
       "bodies.crank.markers.com: the name \"com\" is taken"},
      {"step: 0.01", "step: 2", [](ModelDescription& d) { d.simulation->step = 2; },
       "simulation.step: the step of 2 s is longer than the duration of 1 s"},
      {"of: rod/mid", "of: crank/pin",
       [](ModelDescription& d) {
         auto& of = std::get<model::DeflectionSensor>(d.output.sensors.at(0).kind).of;
         of.body = "crank";
         of.marker = "pin";
         of.text = "crank/pin";
       },
       "output.sensors.bend.deflection.of: \"crank/pin\" is not on a flexible body"},
      {"planar: xy", "planar: xy\ngravity: [0, 0, -9.81]",
       [](ModelDescription& d) { d.gravity.z() = -9.81; },
       "gravity: gravity of a planar model must lie in its plane"},
  };
}

/// The message without its position in the file.
template <class Work>
std::string refusal_of(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.text();
  }
  return "";
}

TEST(Findings, TextAndProgramAreRefusedInTheSameWords) {
  std::vector<Fault> faults = faults_of_bodies();
  for (Fault& fault : faults_between_bodies()) faults.push_back(std::move(fault));
  for (const Fault& fault : faults) {
    std::string text = kModel;
    const std::size_t at = text.find(fault.from);
    ASSERT_NE(at, std::string::npos) << fault.from;
    text.replace(at, std::string(fault.from).size(), fault.to);
    const std::string from_file = refusal_of([&] { read_model_text(text, "model.yaml"); });
    model::ModelDescription d = read_model_text(kModel, "model.yaml");
    fault.in_code(d);
    const std::string from_code = refusal_of([&] { model::build_model(d); });
    EXPECT_THAT(from_file, ::testing::StartsWith(fault.words));
    EXPECT_EQ(from_code, from_file);
  }
}

TEST(Findings, SoundModelHasNone) {
  EXPECT_FALSE(model::check(read_model_text(kModel, "model.yaml")).has_value());
}

TEST(Findings, ProgramWithoutAFileIsToldTheFieldAlone) {
  model::ModelDescription d = read_model_text(kModel, "model.yaml");
  d.where = {};
  d.bodies.at(1).where = {};
  auto& beam = kind_of<fem::BeamSpec>(d, 1);
  beam.where = {};
  beam.to = beam.from;
  try {
    model::build_model(d);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_TRUE(error.where().empty());
    EXPECT_THAT(error.what(), ::testing::StartsWith("bodies.rod.beam.to: "));
  }
}

TEST(Findings, NumbersThatAreNone) {
  model::ModelDescription d = read_model_text(kModel, "model.yaml");
  d.gravity.y() = std::numeric_limits<double>::quiet_NaN();
  const auto found = model::check(d);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->field_path, "gravity.1");
  EXPECT_EQ(found->text, "nan is not allowed: the value must be a finite number");
}

}  // namespace
}  // namespace buckens::model_file
