// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/interface_loads.h"

#include <algorithm>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/summed_coordinate.h"

namespace buckens::results {

using Eigen::Vector3d;
using model::MarkerId;
using spatial::Wrench;

namespace {

const std::string& marker_name(const model::Model& model, const MarkerId& id) {
  return model.bodies[static_cast<std::size_t>(id.body)]
      .markers[static_cast<std::size_t>(id.marker)]
      .name;
}

}  // namespace

InterfaceLoads::InterfaceLoads(const model::Model& model, const model::FieldPlaces& places)
    : model_(model), whole_(places.whole) {
  const auto is_wanted = [&places](const std::string& name) {
    return places.is_everywhere ||
           std::find(places.names.begin(), places.names.end(), name) != places.names.end();
  };
  const auto add_side = [&](const MarkerId& id, const Share& share) {
    if (!is_of_body(id)) return;
    const std::string& name = marker_name(model, id);
    if (is_wanted(name)) add("interfaces/" + name, false, share);
  };
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const model::Joint& joint = model.joints[k];
    if (joint.is_tie) continue;
    for (std::size_t c = 0; c < std::max<std::size_t>(joint.coupled.size(), 1); ++c) {
      const model::Joint& owner = markers_of(joint, c);
      // The beam under a slider has no place with a name.
      if (!owner.track) add_side(owner.first, {k, true, Side::first, c});
      add_side(owner.second, {k, true, Side::second, c});
    }
  }
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    if (!load.region) {
      add_side(load.first, {k, false, Side::first, 0});
      add_side(load.second, {k, false, Side::second, 0});
      for (std::size_t m = 0; m < load.others.size(); ++m) {
        add_side(load.others[m], {k, false, Side::other, m});
      }
    } else if (is_of_body(load.first) && is_wanted(model::part_of_place(load.region->place))) {
      add("loads/" + load.name, true, {k, false, Side::first, 0});
    }
  }
}

const model::Joint& InterfaceLoads::markers_of(const model::Joint& joint,
                                               std::size_t coupled) const {
  if (joint.coupled.empty()) return joint;
  const auto index = static_cast<std::size_t>(joint.coupled[coupled].coordinate);
  return model_.joints[static_cast<std::size_t>(model_.coordinates[index].joint)];
}

bool InterfaceLoads::is_of_body(const MarkerId& id) const {
  return id.body != model::kGround && model_.whole_of(id.body) == whole_;
}

void InterfaceLoads::add(const std::string& path, bool is_distributed, const Share& share) {
  auto known = std::find_if(places_.begin(), places_.end(),
                            [&path](const Place& place) { return place.path == path; });
  if (known == places_.end()) known = places_.insert(known, {path, is_distributed, {}});
  known->shares.push_back(share);
}

const MarkerId& InterfaceLoads::marker_of(const Share& share) const {
  const bool is_first = share.side == Side::first;
  if (share.is_joint) {
    const model::Joint& owner = markers_of(model_.joints[share.index], share.coupled);
    return is_first ? owner.first : owner.second;
  }
  const model::Load& load = model_.loads[share.index];
  if (share.side == Side::other) return load.others[share.coupled];
  return is_first ? load.first : load.second;
}

void InterfaceLoads::add_channels(FieldLayout& layout) const {
  const std::string& body = model_.wholes[static_cast<std::size_t>(whole_)].name;
  for (const Place& place : places_) {
    layout.fields.add({"fields/bodies/" + body + "/" + place.path,
                       "N, N m",
                       {6},
                       place.is_distributed
                           ? "on the body, torque about the origin of its frame, world axes"
                           : "on the body, torque about the marker's origin, world axes",
                       {"Fx", "Fy", "Fz", "Mx", "My", "Mz"}});
  }
}

Wrench InterfaceLoads::wrench_of(const Share& share, const model::State& state,
                                 const std::vector<dynamics::BodyMotion>& motions,
                                 const linalg::Vector& lambda, double load_factor) const {
  const auto motion = [&](const MarkerId& id) {
    return dynamics::evaluate_marker(model_, id, motions).motion;
  };
  const bool is_first = share.side == Side::first;
  if (share.is_joint) {
    const model::Joint& joint = model_.joints[share.index];
    if (joint.track) {
      return dynamics::Travel(model_, joint, motions, &state.memory).reaction(state.t, lambda);
    }
    if (!joint.coupled.empty()) {
      const dynamics::JointWrenches both =
          dynamics::SummedCoordinate(model_, joint.coupled[share.coupled], motions, state.t,
                                     &state.memory)
              .wrenches(lambda[joint.first_row]);
      return is_first ? both.on_first : both.on_second;
    }
    const dynamics::JointWrenches both = dynamics::wrenches_of(
        joint, state.t, &state.memory, lambda, motion(joint.first), motion(joint.second));
    return is_first ? both.on_first : both.on_second;
  }
  const model::Load& load = model_.loads[share.index];
  const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, &state.memory);
  const dynamics::Circumstances around = dynamics::circumstances_of(state);
  if (share.side == Side::other) {
    std::vector<Wrench> others(load.others.size());
    dynamics::add_to_others(model_, share.index, state.t, around, ends, others);
    return others[share.coupled];
  }
  const loads::Action action = dynamics::action_of(model_, share.index, state.t, around, ends);
  Wrench out = is_first ? action.on_first : action.on_second;
  if (load.element->is_applied()) {
    out.force *= load_factor;
    out.torque *= load_factor;
  }
  return out;
}

void InterfaceLoads::append(const model::State& state,
                            const std::vector<dynamics::BodyMotion>& motions,
                            const linalg::Vector& lambda, double load_factor,
                            std::vector<double>& values) const {
  const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(whole_)];
  const Vector3d origin = model::whole_motion(model_, whole, state).X_WB.p;
  for (const Place& place : places_) {
    Wrench sum;
    for (const Share& share : place.shares) {
      Wrench one = wrench_of(share, state, motions, lambda, load_factor);
      if (place.is_distributed) {
        const Vector3d at = dynamics::evaluate_marker(model_, marker_of(share), motions).motion.p;
        one.torque += (at - origin).cross(one.force);
      }
      sum += one;
    }
    for (const Vector3d& v : {sum.force, sum.torque}) {
      values.insert(values.end(), v.data(), v.data() + 3);
    }
  }
}

}  // namespace buckens::results
