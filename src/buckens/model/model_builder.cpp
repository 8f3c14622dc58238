// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/model_builder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assemble.h"
#include "buckens/fem/recovery.h"
#include "buckens/model/add_joint.h"
#include "buckens/model/add_load.h"
#include "buckens/model/marker_finder.h"
#include "buckens/model/mesh_mechanism.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// sin of the angle up to which a body counts as lying in the plane of a planar model.
constexpr double kInPlane = 1e-6;

class Builder {
 public:
  explicit Builder(ModelDescription description)
      : out_(std::make_unique<BuiltModel>()), model_(out_->model) {
    out_->description = std::move(description);
  }

  std::unique_ptr<BuiltModel> run() {
    const ModelDescription& d = out_->description;
    model_.title = d.title;
    model_.gravity = d.gravity;
    model_.planar = d.planar;
    check_gravity();
    add_bodies();
    MarkerFinder find(model_, tables_);
    for (const joints::JointSpec& joint : d.joints) add_joint(joint, find);
    for (const loads::LoadSpec& load : d.loads) add_load(load, find);
    close_interfaces();
    for (const SensorSpec& sensor : d.output.sensors) add_sensor(sensor, find);
    add_remaining_markers();
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (model_.bodies[b].is_flexible()) model_.bodies[b].flexible->rows = tables_[b]->rows();
    }
    model_.length = characteristic_length();
    return std::move(out_);
  }

 private:
  // ---- bodies
  void check_gravity() const {
    if (!model_.planar) return;
    if (std::abs(model_.gravity.dot(spatial::normal(*model_.planar))) > 0.0) {
      throw InputError(out_->description.where,
                       "gravity of a planar model must lie in its plane; set the component normal "
                       "to it to zero");
    }
  }

  void add_bodies() {
    const auto& specs = out_->description.bodies;
    model_.bodies.resize(specs.size());  // markers tables keep references
    meshes_.resize(specs.size());
    for (std::size_t b = 0; b < specs.size(); ++b) {
      try {
        add_body(b, specs[b]);
      } catch (const ModelError& error) {
        if (!error.where().empty()) throw;
        const std::string what = error.what();
        const bool is_named = what.find('"' + specs[b].name + '"') != std::string::npos;
        throw ModelError(specs[b].where,
                         is_named ? what : fmt::format("body \"{}\": {}", specs[b].name, what));
      }
    }
  }

  void add_body(std::size_t b, const body::BodySpec& spec) {
    body::Body& body = model_.bodies[b];
    body.name = spec.name;
    const Matrix3d R = spec.at.rotation().toRotationMatrix();
    std::optional<Vector3d> normal_B;
    if (model_.planar) {
      const Vector3d normal_W = spatial::normal(*model_.planar);
      normal_B = R.transpose() * normal_W;
      if (normal_B->cross(normal_W).norm() > kInPlane) {
        throw InputError(spec.where, fmt::format("body \"{}\" is turned out of the plane of the "
                                                 "planar model; only rotations about its normal "
                                                 "are possible",
                                                 spec.name));
      }
    }
    if (const auto* rigid = std::get_if<body::RigidSpec>(&spec.kind)) {
      body.mass = rigid->mass;
      body.com = rigid->com;
      body.J0 = rigid->inertia_matrix();
    } else {
      meshes_[b] = std::make_unique<NamedStructure>(structure_from_spec(spec));
      fem::FeModel fe = fem::assemble(meshes_[b]->structure, model_.planar);
      body.mass = fe.shape.mass;
      body.com = fe.shape.com;
      body.J0 = fe.shape.J0;
      body.flexible = std::make_unique<body::FlexiblePart>(spec.name, std::move(fe), spec.coupling);
      refuse_mechanisms(body);
    }
    if (!(body.mass > 0.0)) {
      throw ModelError(spec.where,
                       fmt::format("body \"{}\" has no mass; every body needs inertia, if only a "
                                   "little (merge a massless part with its neighbour)",
                                   spec.name));
    }
    body::select_frame_coordinates(body, normal_B, model_.notes);
    model_.placed.push_back(spatial::Pose{spec.at.position, spec.at.rotation()} *
                            spatial::Pose{body.com, Eigen::Quaterniond::Identity()});
    tables_.push_back(std::make_unique<MarkerTable>(spec, body, meshes_[b].get()));
  }

  void close_interfaces() {
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      if (model_.bodies[b].is_flexible()) {
        model_.bodies[b].flexible->num_interface_rows = tables_[b]->num_rows();
      }
    }
  }

  // ---- sensors and drawing
  void add_sensor(const SensorSpec& spec, MarkerFinder& find) {
    SensorPlace found;
    const auto look = [&](const base::MarkerRef& ref) {
      found.markers.push_back(find.marker(ref, false));
    };
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.element; }) {
            find_section(kind, find, found);
            return;
          }
          if constexpr (requires { kind.between; }) {
            look(kind.between[0]);
            look(kind.between[1]);
          }
          if constexpr (requires { kind.of; }) look(kind.of);
          if constexpr (requires { kind.in; }) {
            if (kind.in) look(*kind.in);
          }
          if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, DeflectionSensor>) {
            if (kind.from == DeflectionBase::chord && !kind.of.is_ground()) {
              base::MarkerRef end = kind.of;
              for (const char* name : {"start", "end"}) {
                end.marker = name;
                look(end);
              }
            }
          }
        },
        spec.kind);
    out_->sensors.push_back(std::move(found));
  }

  void find_section(const SectionPlace& kind, MarkerFinder& find, SensorPlace& found) {
    found.body = find.marker(kind.of, false).body;
    if (found.body == kGround || !model_.bodies[static_cast<std::size_t>(found.body)].flexible) {
      throw ModelError(kind.of.where,
                       fmt::format("\"{}\" is not on a flexible body; section forces "
                                   "and stresses exist on beams and bars only",
                                   kind.of.text));
    }
    const auto b = static_cast<std::size_t>(found.body);
    const auto lines = fem::line_elements(model_.bodies[b].flexible->fe);
    if (kind.element) {
      found.element = *kind.element - 1;
      if (found.element >= static_cast<int>(lines.size())) {
        throw InputError(kind.of.where, fmt::format("body \"{}\" has {} elements, not {}",
                                                    kind.of.body, lines.size(), *kind.element));
      }
      return;
    }
    const auto place = tables_[b]->place(kind.of);
    if (!place) return;
    if (place->node < 0) found.element = place->element;
    for (std::size_t e = 0; e < lines.size() && found.element < 0; ++e) {
      if (lines[e].a != place->node && lines[e].b != place->node) continue;
      found.element = static_cast<int>(e);
      found.end = lines[e].a == place->node ? 0 : 1;
    }
  }

  void add_remaining_markers() {
    for (std::size_t b = 0; b < tables_.size(); ++b) {
      base::MarkerRef ref;
      ref.body = model_.bodies[b].name;
      for (const body::MarkerSpec& marker : out_->description.bodies[b].markers) {
        ref.marker = marker.name;
        ref.where = marker.where;
        tables_[b]->find(ref, false);
      }
    }
  }

  double characteristic_length() const {
    Eigen::AlignedBox3d box;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const body::Body& body = model_.bodies[b];
      box.extend(model_.placed[b].p);
      for (const body::Marker& marker : body.markers) {
        box.extend((model_.placed[b] * marker.X_BF).p);
      }
      if (!body.is_flexible()) continue;
      for (const auto& node : body.flexible->fe.nodes) {
        box.extend(model_.placed[b] * Vector3d(node.position - body.com));
      }
    }
    const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
    return size > 0.0 ? size : 1.0;
  }

  std::unique_ptr<BuiltModel> out_;
  Model& model_;
  std::vector<std::unique_ptr<NamedStructure>> meshes_;
  std::vector<std::unique_ptr<MarkerTable>> tables_;
};

}  // namespace

std::unique_ptr<BuiltModel> build_model(ModelDescription description) {
  return Builder(std::move(description)).run();
}

}  // namespace buckens::model
