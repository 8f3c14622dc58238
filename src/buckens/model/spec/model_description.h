// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/expression.h"
#include "buckens/base/field.h"
#include "buckens/body/body_spec.h"
#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/line/section_spec.h"
#include "buckens/joints/joint_spec.h"
#include "buckens/loads/force_element.h"
#include "buckens/loads/load_spec.h"
#include "buckens/model/spec/event_spec.h"
#include "buckens/model/spec/initial_spec.h"
#include "buckens/model/spec/sensor_spec.h"
#include "buckens/model/spec/signal_spec.h"
#include "buckens/model/spec/simulation_spec.h"
#include "buckens/model/spec/static_spec.h"
#include "buckens/spatial/plane.h"

namespace buckens::spatial {

constexpr std::array<const char*, 3> choice_names(Plane) { return {"yz", "zx", "xy"}; }

}  // namespace buckens::spatial

namespace buckens::model {

/// A named value for use in expressions, SI.
struct ParameterSpec {
  std::string name;
  SourceLocation where;
  double value = 0;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(value, "number, quantity or expression of parameters above it")
              .of_any_dimension()
              .required()
              .like("300 mm"));
  }
};

/// A force law between two markers in code; a model file cannot express it.
struct OwnForce {
  std::string name;
  SourceLocation where;
  base::MarkerRef first, second;
  std::shared_ptr<const loads::ForceElement> element;
};

/// Handling of joints that are open with the bodies as placed.
enum class AssemblyRule { adjust, strict };

constexpr std::array<const char*, 2> choice_names(AssemblyRule) { return {"adjust", "strict"}; }

/// The contents of a model file, in SI units, with names resolved and checked as far as possible
/// without building the model.
struct ModelDescription {
  // In model_description.cpp, because they reach through all members: two to five seconds of
  // compiling each.
  ModelDescription();
  ModelDescription(const ModelDescription&);
  ModelDescription(ModelDescription&&) noexcept;
  ModelDescription& operator=(const ModelDescription&);
  ModelDescription& operator=(ModelDescription&&) noexcept;
  ~ModelDescription();

  int format = 1;
  std::string title;
  std::string base;  ///< as `directory`, as written: relative to the model file, or empty
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²]
  std::optional<spatial::Plane> planar;
  AssemblyRule assembly = AssemblyRule::adjust;
  std::vector<ParameterSpec> parameters;
  std::vector<fem::MaterialSpec> materials;
  std::vector<fem::SectionSpec> sections;
  std::vector<body::BodySpec> bodies;
  std::vector<joints::JointSpec> joints;
  std::vector<SignalSpec> signals;
  std::vector<EventSpec> events;
  std::vector<loads::LoadSpec> loads;
  std::vector<OwnForce> own_forces;  ///< of models made in code
  InitialSpec initial;
  std::optional<SimulationSpec> simulation;  ///< absent: the model can be checked, not run
  std::optional<StaticSpec> static_path;     ///< absent: the defaults of StaticSpec
  OutputSpec output;
  SourceLocation where;   ///< the file
  std::string directory;  ///< relative file names start here
  /// Text of a model file for this model: the one that was read, with overrides applied.
  std::string source;
  std::vector<std::string> warnings;  ///< about implausible values; see plausibility.h

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("buckens", format, "version of the file format, 1").required().like("1"));
    visit(base::field("title", title, "one line about the model").like("Flexible slider-crank"));
    visit(base::field("base", base, "directory in which relative file names begin")
              .like("../meshes")
              .otherwise("that of the model file"));
    // Before everything that may contain an expression.
    visit(base::field("parameters", parameters, "named values for use in expressions")
              .like("{L: 300 mm, speed: 150}"));
    visit(base::field("gravity", gravity, "acceleration of gravity, world axes")
              .in(base::kAcceleration)
              .like("[0, -9.81 m/s^2, 0]"));
    visit(base::field("planar", planar, "plane of a planar model").otherwise("a model in space"));
    visit(base::field("assembly", assembly,
                      "where joints are open with the bodies as placed: `adjust` moves bodies as "
                      "little as possible and reports it, `strict` refuses more than 1e-3 of the "
                      "model's size or 1e-3 rad"));
    visit(base::field("materials", materials, "materials by name")
              .like("{steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}"));
    visit(base::field("sections", sections, "cross-sections by name")
              .like("{rod6: {circle: {diameter: 6 mm}}}"));
    visit(base::field("bodies", bodies, "bodies by name").required());
    visit(base::field("joints", joints, "joints by name"));
    visit(base::field("signals", signals,
                      "named numbers that vary with the motion, for motors, loads and other "
                      "signals")
              .like("{angle: {joint-angle: elbow}, u: \"20*(0.5 - angle)\"}"));
    visit(base::field("loads", loads, "loads and force laws by name"));
    visit(base::field("events", events, "what happens when signals go through zero")
              .like("{landed: {when: height, direction: falling, do: stop}}"));
    visit(base::field("initial", initial, "how the motion starts").otherwise("at rest, as placed"));
    visit(base::field("simulation", simulation, "duration and time step")
              .otherwise("the model can be checked but not run"));
    visit(base::field("static", static_path, "equilibria over a load factor, for `buckens static`")
              .otherwise("the factor runs from 0 to 1"));
    visit(base::field("output", output, "what is recorded"));
  }
};

}  // namespace buckens::model
