// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::model::test {

using Eigen::Vector3d;

/// Line of an imaginary model file, expected in messages.
inline SourceLocation at_line(int line) { return {"test.yaml", line, 1}; }

/// "ground", "rod" or "rod/end".
inline base::MarkerRef at_marker(const std::string& text) {
  base::MarkerRef out;
  const auto slash = text.find('/');
  out.body = text.substr(0, slash);
  if (slash != std::string::npos) out.marker = text.substr(slash + 1);
  out.text = text;
  out.where = at_line(99);
  return out;
}

inline std::array<base::TimeLaw, 3> constant_law(const Vector3d& value) {
  return {base::TimeLaw::constant(value.x()), base::TimeLaw::constant(value.y()),
          base::TimeLaw::constant(value.z())};
}

/// Section 20 mm (y) × 30 mm (z) of steel.
inline constexpr double kE = 2e11;
inline constexpr double kWidth = 0.02;
inline constexpr double kHeight = 0.03;
inline constexpr double kArea = kWidth * kHeight;
inline constexpr double kIz = kHeight * kWidth * kWidth * kWidth / 12;  // bending in x-y
inline constexpr double kRho = 7800;

/// A model description under construction, as in a model file.
struct Described {
  ModelDescription d;

  Described() { d.where = at_line(0); }

  body::BodySpec& body(const std::string& name) {
    body::BodySpec spec;
    spec.name = name;
    spec.where = at_line(10 + static_cast<int>(d.bodies.size()));
    d.bodies.push_back(std::move(spec));
    return d.bodies.back();
  }

  body::BodySpec& rigid(const std::string& name, double mass, const Vector3d& com,
                        const Vector3d& inertia) {
    body::RigidSpec kind;
    kind.mass = mass;
    kind.com = com;
    kind.inertia = {inertia.x(), inertia.y(), inertia.z()};
    body::BodySpec& spec = body(name);
    spec.kind = kind;
    return spec;
  }

  static void make_steel(fem::BeamPropertySpec& beam) {
    beam.section.value.shape = fem::RectangleSpec{kWidth, kHeight};
    beam.material.value.E = kE;
    beam.material.value.nu = 0.3;
    beam.material.value.rho = kRho;
  }

  body::BodySpec& beam(const std::string& name, const Vector3d& from, const Vector3d& to,
                       int elements) {
    fem::BeamSpec kind;
    kind.from = from;
    kind.to = to;
    kind.elements = elements;
    make_steel(kind);
    body::BodySpec& spec = body(name);
    spec.kind = kind;
    return spec;
  }

  /// Bars of 1 cm² between the named nodes.
  body::BodySpec& truss(const std::string& name,
                        const std::vector<std::pair<std::string, Vector3d>>& nodes,
                        const std::vector<std::array<std::string, 2>>& bars) {
    fem::StructureSpec kind;
    for (const auto& [node, position] : nodes) {
      kind.nodes.push_back({node, at_line(20), position});
    }
    for (const auto& between : bars) {
      fem::BarMemberSpec bar;
      bar.between = between;
      bar.where = at_line(30);
      bar.area = 1e-4;
      bar.material.value.E = kE;
      bar.material.value.rho = kRho;
      kind.bars.push_back(bar);
    }
    body::BodySpec& spec = body(name);
    spec.kind = kind;
    return spec;
  }

  /// Block of hex8 elements of steel from the origin of the model axes.
  body::BodySpec& block(const std::string& name, const Vector3d& size,
                        const std::array<int, 3>& divisions) {
    fem::BoxMeshSpec box;
    box.size = size;
    box.divisions = divisions;
    box.integration = fem::SolidIntegration::full;
    fem::MeshSpec kind;
    kind.shape = box;
    kind.material.emplace();
    kind.material->value.E = kE;
    kind.material->value.nu = 0.3;
    kind.material->value.rho = kRho;
    body::BodySpec& spec = body(name);
    spec.kind = kind;
    return spec;
  }

  static body::MarkerSpec marker(const std::string& name, const Vector3d& position) {
    body::MarkerSpec out;
    out.name = name;
    out.where = at_line(40);
    out.position = position;
    return out;
  }

  template <class Kind>
  Kind& joint(const std::string& name, const std::string& first, const std::string& second) {
    Kind kind;
    kind.between = {at_marker(first), at_marker(second)};
    joints::JointSpec spec;
    spec.name = name;
    spec.where = at_line(50);
    spec.kind = kind;
    d.joints.push_back(std::move(spec));
    return std::get<Kind>(d.joints.back().kind);
  }

  /// A force or torque on a marker, a spring between two.
  template <class Kind>
  Kind& load(const std::string& name) {
    loads::LoadSpec spec;
    spec.name = name;
    spec.where = at_line(60);
    spec.kind = Kind{};
    d.loads.push_back(std::move(spec));
    return std::get<Kind>(d.loads.back().kind);
  }

  void force(const std::string& name, const std::string& on, const Vector3d& value) {
    auto& kind = load<loads::ForceSpec>(name);
    kind.on = at_marker(on);
    kind.value = constant_law(value);
  }

  void torque(const std::string& name, const std::string& on, const Vector3d& value) {
    auto& kind = load<loads::TorqueSpec>(name);
    kind.on = at_marker(on);
    kind.value = constant_law(value);
  }

  template <class Kind>
  Kind& sensor(const std::string& name) {
    SensorSpec spec;
    spec.name = name;
    spec.where = at_line(70);
    spec.kind = Kind{};
    d.output.sensors.push_back(std::move(spec));
    return std::get<Kind>(d.output.sensors.back().kind);
  }

  /// Sensor of a marker: the simplest are named after what they observe.
  template <class Kind>
  Kind& sensor_of(const std::string& name, const std::string& of) {
    Kind& kind = sensor<Kind>(name);
    kind.of = at_marker(of);
    return kind;
  }

  std::unique_ptr<BuiltModel> build() const { return build_model(d); }
};

}  // namespace buckens::model::test
