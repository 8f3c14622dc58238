// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/builder.h"

#include <string_view>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model/check/marker_names.h"

namespace buckens::model {

namespace {

std::array<base::TimeLaw, 3> constant_laws(const Eigen::Vector3d& value) {
  return {base::TimeLaw::constant(value.x()), base::TimeLaw::constant(value.y()),
          base::TimeLaw::constant(value.z())};
}

template <class Spec>
void require_different(const std::vector<Spec>& list) {
  std::unordered_set<std::string_view> names;
  for (const Spec& spec : list) {
    if (names.insert(spec.name).second) continue;
    throw InputError(fmt::format("the name \"{}\" is taken; use another", spec.name));
  }
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
  const body::BodySpec* found = bodies_.find(description_.bodies, body);
  if (found == nullptr) {
    throw InputError(fmt::format("there is no body \"{}\".{}", body,
                                 base::suggestion(body, names_of(description_.bodies))));
  }
  std::vector<body::MarkerSpec>& markers =
      description_.bodies[static_cast<std::size_t>(found - description_.bodies.data())].markers;
  require_new(base::find_named(markers, name) == nullptr, name);
  body::MarkerSpec& marker = markers.emplace_back();
  marker.name = name;
  marker.position = position;
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
  require_new(!loads_.has_seen(description_.loads, name), name);
  OwnForce& force = add_named(description_.own_forces, own_forces_, name);
  force.first = marker(first);
  force.second = marker(second);
  force.element = std::move(element);
}

std::unique_ptr<BuiltModel> ModelBuilder::build() const {
  require_different(description_.bodies);
  require_different(description_.joints);
  require_different(description_.loads);
  require_different(description_.own_forces);
  require_different(description_.output.sensors);
  return build_model(description_);
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
