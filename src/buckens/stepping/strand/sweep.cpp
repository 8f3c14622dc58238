// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/sweep.h"

#include <algorithm>
#include <functional>

namespace buckens::stepping::strand {

Sweep::Sweep(const std::vector<BodyBlock>& bodies, const std::vector<JointBlock>& joints)
    : last_joint_(bodies.size(), 0), last_body_(joints.size(), 0) {
  std::vector<std::pair<const double*, std::size_t>> places;
  for (std::size_t b = 0; b < bodies.size(); ++b) places.emplace_back(bodies[b].rows, b);
  std::sort(places.begin(), places.end(), [](const auto& one, const auto& other) {
    return std::less<>()(one.first, other.first);
  });
  for (std::size_t j = 0; j < joints.size(); ++j) {
    for (const auto& ends : joints[j].body) {
      for (const double* const end : ends) {
        auto found = std::upper_bound(
            places.begin(), places.end(), end,
            [](const double* at, const auto& place) { return std::less<>()(at, place.first); });
        // The ground is in no block.
        if (found == places.begin() || end - (--found)->first >= kLanes) continue;
        last_body_[j] = std::max(last_body_[j], found->second + 1);
        last_joint_[found->second] = std::max(last_joint_[found->second], j + 1);
      }
    }
  }
  for (auto* const needs : {&last_joint_, &last_body_}) {
    for (std::size_t k = 1; k < needs->size(); ++k) {
      (*needs)[k] = std::max((*needs)[k], (*needs)[k - 1]);
    }
  }
}

}  // namespace buckens::stepping::strand
