// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/shaft_pairs.h"

#include <algorithm>

namespace buckens::model {

using joints::JointType;

namespace {

int whole_with(const Model& model, int body) {
  return body == kGround || model.wholes.empty() ? body : model.whole_of(body);
}

std::vector<Bearing> bearings_of(const Model& model, int body) {
  std::vector<Bearing> out;
  for (const Joint& joint : model.joints) {
    const bool holds = joint.type == JointType::revolute || joint.type == JointType::cylindrical ||
                       joint.type == JointType::screw;
    if (!holds || joint.is_tie) continue;
    if (joint.first.body != body && joint.second.body != body) continue;
    out.push_back({&joint, joint.first.body == body ? joint.second.body : joint.first.body});
  }
  return out;
}

/// Whether a joint holds two places of bodies together.
bool holds_together(const Model& model, int one, int other) {
  return std::any_of(model.joints.begin(), model.joints.end(), [&](const Joint& joint) {
    const bool is_hinge = joint.type == JointType::revolute || joint.type == JointType::spherical ||
                          joint.type == JointType::prismatic || joint.type == JointType::fixed ||
                          joint.type == JointType::cylindrical ||
                          joint.type == JointType::universal ||
                          joint.type == JointType::constant_velocity;
    if (!is_hinge || joint.is_tie) return false;
    const int first = whole_with(model, joint.first.body);
    const int second = whole_with(model, joint.second.body);
    return (first == one && second == other) || (first == other && second == one);
  });
}

}  // namespace

std::vector<ShaftPair> shaft_pairs(const Model& model) {
  std::vector<ShaftPair> out;
  for (const Joint& cross : model.joints) {
    if (cross.type != JointType::universal) continue;
    if (cross.first.body == kGround || cross.second.body == kGround) continue;
    for (const Bearing& one : bearings_of(model, cross.first.body)) {
      for (const Bearing& two : bearings_of(model, cross.second.body)) {
        if (one.joint == two.joint) continue;
        const int first = whole_with(model, one.on);
        const int second = whole_with(model, two.on);
        if (first != second && !holds_together(model, first, second)) continue;
        out.push_back({&cross, one, two, first == second});
      }
    }
  }
  return out;
}

}  // namespace buckens::model
