// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_gear_teeth.h"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/elastic_gear.h"
#include "buckens/model/gear_flank.h"

namespace buckens::model {

namespace {

/// Which bodies hang together, the ground among them.
class Assemblies {
 public:
  explicit Assemblies(std::size_t num_bodies) : leader_(num_bodies + 1) {
    std::iota(leader_.begin(), leader_.end(), std::size_t{0});
  }
  void connect(int a, int b) { leader_[find(a)] = find(b); }
  bool are_connected(int a, int b) { return find(a) == find(b); }

 private:
  std::size_t find(int body) {
    auto k = static_cast<std::size_t>(body + 1);  // the ground is -1
    while (leader_[k] != k) k = leader_[k] = leader_[leader_[k]];
    return k;
  }
  std::vector<std::size_t> leader_;
};

/// cos² β_b: from normal to the teeth to the line of action across the axes, by the helix at the
/// base circle.
double square_of_normal(double pressure_angle, double helix_angle) {
  const double sine = std::sin(helix_angle) * std::cos(pressure_angle);
  return 1.0 - sine * sine;
}

void require_connected(Assemblies& parts, const Model& model, const MarkerId& first,
                       const MarkerId& second, const std::string& what,
                       const SourceLocation& where) {
  if (parts.are_connected(first.body, second.body)) return;
  const auto name = [&](const MarkerId& id) {
    return id.body == kGround ? std::string("the ground")
                              : '"' + model.bodies[static_cast<std::size_t>(id.body)].name + '"';
  };
  throw ModelError(
      where, fmt::format("{}: its gears have no common carrier, since nothing else connects {} and "
                         "{}; a gear pair does not hold the distance between its shafts: support "
                         "both, for example by `revolute` joints, on the ground or on a housing",
                         what, name(first), name(second)));
}

}  // namespace

void require_common_carriers(const Model& model) {
  Assemblies parts(model.bodies.size());
  // A rack holds its pinion no more than a gear does, but slides: it may hang on its teeth alone.
  const auto is_teeth = [](const Load& load) {
    return load.kind == joints::GearSpec::kKey || load.kind == loads::ElasticGearSpec::kKey;
  };
  for (const Joint& joint : model.joints) {
    if (joint.type != joints::JointType::gear) parts.connect(joint.first.body, joint.second.body);
  }
  for (const Load& load : model.loads) {
    if (!load.element->is_applied() && !is_teeth(load)) {
      parts.connect(load.first.body, load.second.body);
    }
  }
  for (const Joint& joint : model.joints) {
    if (joint.type != joints::JointType::gear) continue;
    require_connected(parts, model, joint.first, joint.second,
                      fmt::format("joint \"{}\"", joint.name), joint.where);
  }
  for (const Load& load : model.loads) {
    if (!is_teeth(load)) continue;
    require_connected(parts, model, load.first, load.second,
                      fmt::format("{} \"{}\"", load.is_among_joints ? "joint" : "load", load.name),
                      {});
  }
}

void set_gear_teeth(const loads::ElasticGearSpec& spec, MarkerFinder& find, Load& load,
                    const SourceLocation& where) {
  const std::string what = fmt::format("load \"{}\"", load.name);
  load.first = find.marker(spec.between[0], true);
  load.second = find.marker(spec.between[1], true);
  find.require_two_bodies(load.first, load.second, what, where);
  find.require_moment(load.first, what, where);
  find.require_moment(load.second, what, where);
  joints::Placement p = find.placement(load.first, load.second);
  p.axis_F = find.axis_or_normal(spec.axis, p.R_WF, what, where);
  joints::GearMesh::Data mesh;
  mesh.axis_F = joints::unit_axis(p);
  find.require_across_plane(p.R_WF * mesh.axis_F, "gears", what, where);
  mesh.r_F = p.r_F;
  mesh.R_FM = p.R_WF.transpose() * p.R_WM;
  mesh.sizes = spec.teeth;
  mesh.same_sense = spec.internal;
  mesh.pressure_angle = spec.pressure_angle;
  mesh.helix_angle = spec.helix_angle;
  // From the pitch circle to the base circle.
  const double transverse = joints::transverse_angle(spec.pressure_angle, spec.helix_angle);
  const double normal = square_of_normal(spec.pressure_angle, spec.helix_angle);
  const ElasticGear::Data data{spec.stiffness * normal, spec.damping * normal,
                               spec.backlash * std::cos(transverse), std::sqrt(normal)};
  try {
    load.element = std::make_unique<ElasticGear>(mesh, data);
  } catch (const ModelError& error) {
    throw ModelError(where, fmt::format("{}: {}", what, error.what()));
  }
}

void add_flanks(const joints::ToothPlay& spec, const Joint& joint,
                const joints::Placement& placement, Model& model) {
  const joints::FlankGaps flanks = joints::make_flank_gaps(joint.type, placement, spec.backlash);
  const bool is_gear = joint.type == joints::JointType::gear;
  const double size = is_gear ? placement.r_F.norm() : placement.sizes[0];
  GearFlank::Data data;
  data.play = flanks.play;
  data.period = flanks.period;
  data.pitch_cosine =
      std::cos(joints::transverse_angle(placement.pressure_angle, placement.helix_angle));
  data.normal_cosine = std::sqrt(square_of_normal(placement.pressure_angle, placement.helix_angle));
  data.axis_F = joint.axis_F;
  for (std::size_t k = 0; k < flanks.gaps.size(); ++k) {
    data.side = k == 0 ? 1.0 : -1.0;
    Load load;
    load.name = joint.name;
    load.kind = joints::to_string(joint.type);
    load.is_among_joints = true;
    load.first = joint.first;
    load.second = joint.second;
    load.coordinate = static_cast<int>(model.coordinates.size());
    model.coordinates.push_back({-1, joint.first, joint.second, flanks.gaps[k]});
    load.element =
        std::make_shared<GearFlank>(data, spec.restitution.value_or(0.0),
                                    spec.threshold.value_or(loads::RigidStop::kAtRest * size));
    model.loads.push_back(std::move(load));
  }
}

}  // namespace buckens::model
