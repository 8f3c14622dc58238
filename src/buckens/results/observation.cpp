// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/observation.h"

#include <algorithm>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/summed_coordinate.h"

namespace buckens::results {

namespace {

void add_numbers(const std::vector<int>& more, std::vector<int>& numbers) {
  numbers.insert(numbers.end(), more.begin(), more.end());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

Eigen::Index place_in(const std::vector<int>& numbers, int number) {
  return std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin();
}

}  // namespace

ObservedParts& ObservedParts::operator|=(const ObservedParts& other) {
  energies = energies || other.energies;
  for (const auto& [body, more] : other.bodies) {
    ObservedElements& own = bodies[body];
    own.largest = own.largest || more.largest;
    add_numbers(more.lines, own.lines);
    add_numbers(more.solids, own.solids);
  }
  return *this;
}

Eigen::Index Observation::column_of_line(int body, int element) const {
  const auto some = columns.find(body);
  return some == columns.end() ? element : place_in(some->second.lines, element);
}

Eigen::Index Observation::column_of_solid(int body, int element) const {
  const auto some = columns.find(body);
  return some == columns.end() ? element : place_in(some->second.solids, element);
}

using Eigen::Vector3d;

std::vector<spatial::Wrench> joint_wrenches(const model::Model& model,
                                            const std::vector<dynamics::BodyMotion>& motions,
                                            double t, const model::RowMemory& memory,
                                            const linalg::Vector& lambda) {
  std::vector<spatial::Wrench> out;
  out.reserve(model.joints.size());
  for (const model::Joint& joint : model.joints) {
    if (joint.track) {
      out.push_back(dynamics::Travel(model, joint, motions, &memory).reaction(t, lambda));
      continue;
    }
    if (!joint.coupled.empty()) {
      const dynamics::SummedCoordinate own(model, joint.coupled.front(), motions, t, &memory);
      out.push_back(own.wrenches(lambda[joint.first_row]).on_second);
      continue;
    }
    const auto first = dynamics::evaluate_marker(model, joint.first, motions).motion;
    const auto second = dynamics::evaluate_marker(model, joint.second, motions).motion;
    out.push_back(dynamics::wrenches_of(joint, t, &memory, lambda, first, second).on_second);
  }
  return out;
}

dynamics::Circumstances circumstances_of(const Observation& now) {
  dynamics::Circumstances out = dynamics::circumstances_of(now.state);
  if (!now.signals.empty()) out.signals = &now.signals;
  return out;
}

Vector3d marker_acceleration(const Observation& now, const model::MarkerId& id) {
  if (id.body == model::kGround) return Vector3d::Zero();
  const auto kinematics = dynamics::evaluate_marker(now.model, id, now.motions);
  const auto b = static_cast<std::size_t>(id.body);
  const model::BodyState& s = now.state.bodies[b];
  const body::Body& body = now.model.bodies[b];
  const body::Marker& marker = body.markers[static_cast<std::size_t>(id.marker)];
  Vector3d relative = Vector3d::Zero();
  if (marker.follows_mesh()) {
    const std::vector<linalg::Vector> there = linalg::NodalVector::row_products({&s.d_ddot});
    if (there.empty()) {
      relative = body.flexible->rows.middleRows(marker.translation_row, 3) * s.d_ddot.whole();
    } else {
      relative = there[0].segment<3>(marker.translation_row);
    }
  }
  const Vector3d bias = dynamics::evaluate_bias(now.model, id, now.motions).a;
  return s.v_dot + kinematics.R_WB * (s.w_dot.cross(kinematics.z) + relative) + bias;
}

}  // namespace buckens::results
