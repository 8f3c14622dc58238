// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/blow_islands.h"

#include <utility>

#include "buckens/stepping/mesh_partners.h"

namespace buckens::stepping {

BlowIslands::BlowIslands(const model::Model& model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) leaders_.push_back(b);
  for (const model::Joint& joint : model.joints) {
    const std::vector<int> bodies = bodies_of(model, joint);
    for (const int body : bodies) unite(bodies.front(), body);
  }
  joined_ = leaders_;
}

std::size_t BlowIslands::of(std::size_t body) const {
  while (leaders_[body] != body) body = leaders_[body];
  return body;
}

std::size_t BlowIslands::of(int first, int second) const {
  return of(static_cast<std::size_t>(first != model::kGround ? first : second));
}

void BlowIslands::unite(int first, int second) {
  if (first == model::kGround || second == model::kGround) return;
  std::size_t a = of(static_cast<std::size_t>(first)), b = of(static_cast<std::size_t>(second));
  if (b < a) std::swap(a, b);
  leaders_[b] = a;
}

}  // namespace buckens::stepping
