// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/builder.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

namespace {

std::array<base::TimeLaw, 3> constant_laws(const Eigen::Vector3d& value) {
  return {base::TimeLaw::constant(value.x()), base::TimeLaw::constant(value.y()),
          base::TimeLaw::constant(value.z())};
}

}  // namespace

ModelBuilder::ModelBuilder(std::string title) { description_.title = std::move(title); }

void ModelBuilder::require_new(bool is_new, const std::string& name) {
  if (name.empty() || name.find('/') != name.npos) {
    throw InputError(
        fmt::format("the name \"{}\" is empty or holds a slash; use letters, digits, "
                    "_ and -",
                    name));
  }
  if (!is_new) throw InputError(fmt::format("the name \"{}\" is taken; use another", name));
}

ModelBuilder& ModelBuilder::gravity(const Eigen::Vector3d& g) {
  description_.gravity = g;
  return *this;
}

ModelBuilder& ModelBuilder::planar(spatial::Plane plane) {
  description_.planar = plane;
  return *this;
}

body::BodySpec& ModelBuilder::add_rigid(const std::string& name, double mass,
                                        const Eigen::Vector3d& com,
                                        const Eigen::Vector3d& inertia) {
  body::RigidSpec kind;
  kind.mass = mass;
  kind.com = com;
  kind.inertia = {inertia.x(), inertia.y(), inertia.z()};
  return add_body(name, kind);
}

void ModelBuilder::add_marker(const std::string& body, const std::string& name,
                              const Eigen::Vector3d& position) {
  std::vector<std::string> known;
  for (body::BodySpec& spec : description_.bodies) {
    known.push_back(spec.name);
    if (spec.name == body) {
      add_named(spec.markers, name).position = position;
      return;
    }
  }
  throw InputError(fmt::format("there is no body \"{}\".{}", body, base::suggestion(body, known)));
}

void ModelBuilder::add_force(const std::string& name, const std::string& on,
                             const Eigen::Vector3d& value) {
  loads::ForceSpec kind;
  kind.on = marker(on);
  kind.value = constant_laws(value);
  add_load(name, std::move(kind));
}

void ModelBuilder::add_torque(const std::string& name, const std::string& on,
                              const Eigen::Vector3d& value) {
  loads::TorqueSpec kind;
  kind.on = marker(on);
  kind.value = constant_laws(value);
  add_load(name, std::move(kind));
}

void ModelBuilder::add_force_law(const std::string& name, const std::string& on,
                                 loads::FunctionForce::Law law) {
  add_force_element(name, std::make_shared<loads::FunctionForce>(std::move(law)), on);
}

void ModelBuilder::add_force_element(const std::string& name,
                                     std::shared_ptr<const loads::ForceElement> element,
                                     const std::string& first, const std::string& second) {
  require_new(base::find_named(description_.loads, name) == nullptr, name);
  OwnForce& force = add_named(description_.own_forces, name);
  force.first = marker(first);
  force.second = marker(second);
  force.element = std::move(element);
}

SimulationSpec& ModelBuilder::simulation(double duration, double step) {
  SimulationSpec& spec = description_.simulation.emplace();
  spec.duration = duration;
  spec.step = step;
  return spec;
}

base::MarkerRef ModelBuilder::marker(const std::string& text) {
  base::MarkerRef out;
  const std::size_t slash = text.find('/');
  out.body = text.substr(0, slash);
  if (slash != text.npos) out.marker = text.substr(slash + 1);
  out.text = text;
  return out;
}

base::MarkerRef ModelBuilder::ground(const Eigen::Vector3d& point) {
  base::MarkerRef out = marker("ground");
  out.point = point;
  out.text = fmt::format("ground [{}, {}, {}]", point.x(), point.y(), point.z());
  return out;
}

}  // namespace buckens::model
