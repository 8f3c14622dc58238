// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/base/name_index.h"
#include "buckens/loads/function_force.h"
#include "buckens/model/build/build_model.h"

namespace buckens::model {

/// Builds a model in code from bodies, joints, loads and sensors, in SI units, with the structs
/// that a model file fills and the names of its keys.
///
/// Markers are named as in a model file: "rod/end", "rod", "ground". References returned by the
/// functions are valid until the next call for another entry of the same kind.
class ModelBuilder {
 public:
  explicit ModelBuilder(std::string title = {});

  ModelBuilder& gravity(const Eigen::Vector3d& g);  ///< [m/s²]
  ModelBuilder& planar(spatial::Plane plane);

  // ---- bodies
  /// @param kind RigidSpec, BeamSpec, StructureSpec, MeshSpec, …
  template <class Kind>
  body::BodySpec& add_body(const std::string& name, Kind kind) {
    body::BodySpec& spec = add_named(description_.bodies, bodies_, name);
    spec.kind = std::move(kind);
    return spec;
  }
  /// @param mass [kg], @param inertia about the mass centre in model axes [kg m²]
  body::BodySpec& add_rigid(const std::string& name, double mass, const Eigen::Vector3d& com,
                            const Eigen::Vector3d& inertia);
  /// @param position in model axes [m]. @throws InputError if there is no such body
  void add_marker(const std::string& body, const std::string& name,
                  const Eigen::Vector3d& position);

  // ---- joints and loads
  /// @param kind RevoluteSpec, SphericalSpec, …; its `between` is set here
  template <class Kind>
  Kind& add_joint(const std::string& name, Kind kind, const base::MarkerRef& first,
                  const base::MarkerRef& second) {
    kind.between = {first, second};
    joints::JointSpec& spec = add_named(description_.joints, joints_, name);
    spec.kind = std::move(kind);
    return std::get<Kind>(spec.kind);
  }
  template <class Kind>
  Kind& add_joint(const std::string& name, Kind kind, const std::string& first,
                  const std::string& second) {
    return add_joint(name, std::move(kind), marker(first), marker(second));
  }
  /// @param kind ForceSpec, SpringDamperSpec, …
  template <class Kind>
  Kind& add_load(const std::string& name, Kind kind) {
    loads::LoadSpec& spec = add_named(description_.loads, loads_, name);
    spec.kind = std::move(kind);
    return std::get<Kind>(spec.kind);
  }
  /// Constant force [N] or torque [N m] on a marker, world axes; Simulation::set_load changes it.
  void add_force(const std::string& name, const std::string& on, const Eigen::Vector3d& value);
  void add_torque(const std::string& name, const std::string& on, const Eigen::Vector3d& value);
  /// Force on a marker as a function of time and motion, see loads::FunctionForce.
  void add_force_law(const std::string& name, const std::string& on, loads::FunctionForce::Law law);
  /// A user-defined force law between two markers.
  void add_force_element(const std::string& name,
                         std::shared_ptr<const loads::ForceElement> element,
                         const std::string& first, const std::string& second = "ground");

  // ---- sensors and run
  /// @param kind PositionSensor, JointForceSensor, …
  template <class Kind>
  Kind& add_sensor(const std::string& name, Kind kind) {
    SensorSpec& spec = add_named(description_.output.sensors, sensors_, name);
    spec.kind = std::move(kind);
    return std::get<Kind>(spec.kind);
  }
  /// @param duration,step [s]
  SimulationSpec& simulation(double duration, double step);

  /// "rod/end", "rod" or "ground".
  static base::MarkerRef marker(const std::string& text);
  /// A point fixed to the ground [m].
  static base::MarkerRef ground(const Eigen::Vector3d& point);

  /// The complete description, for everything without a function here.
  ModelDescription& description() { return description_; }
  /// Builds and checks the mechanism; may be called again after changes.
  /// @throws InputError, ModelError with the names of bodies, joints and markers; InputError if two
  /// parts of a kind have one name because one of them was renamed
  std::unique_ptr<BuiltModel> build() const;

 private:
  template <class Spec>
  Spec& add_named(std::vector<Spec>& list, base::NameIndex& index, const std::string& name) {
    require_new(!index.has_seen(list, name), name);
    Spec& spec = list.emplace_back();
    spec.name = name;
    return spec;
  }
  /// @throws InputError if the name is already in use or empty
  static void require_new(bool is_new, const std::string& name);

  ModelDescription description_;
  base::NameIndex bodies_, joints_, loads_, own_forces_, sensors_;  // of those of the description
};

}  // namespace buckens::model
