// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/mesh_partners.h"

#include <algorithm>

namespace buckens::stepping {

std::vector<int> bodies_of(const model::Model& model, const model::Joint& joint) {
  std::vector<int> out{joint.first.body, joint.second.body};
  for (const model::CoupledCoordinate& coupled : joint.coupled) {
    const auto& coordinate = model.coordinates[static_cast<std::size_t>(coupled.coordinate)];
    out.push_back(coordinate.first.body);
    out.push_back(coordinate.second.body);
  }
  if (joint.track) {
    for (const model::MarkerId& node : joint.track->nodes) out.push_back(node.body);
  }
  std::erase(out, model::kGround);
  return out;
}

std::vector<char> mesh_partners(const model::Model& model) {
  std::vector<char> out;
  for (const body::Body& own : model.bodies) {
    out.push_back(own.is_flexible() && !own.flexible->is_quasi_static ? 1 : 0);
  }
  const auto is_in = [&](int body) { return out[static_cast<std::size_t>(body)] != 0; };
  std::vector<std::vector<int>> joined;
  for (const model::Joint& joint : model.joints) joined.push_back(bodies_of(model, joint));
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const std::vector<int>& bodies : joined) {
      if (std::none_of(bodies.begin(), bodies.end(), is_in)) continue;
      for (const int body : bodies) {
        goes_on = goes_on || !is_in(body);
        out[static_cast<std::size_t>(body)] = 1;
      }
    }
  }
  return out;
}

}  // namespace buckens::stepping
