// SPDX-License-Identifier: Apache-2.0
#include "mesh_share.h"

#include <algorithm>
#include <cstddef>

namespace buckens_petsc {

namespace {

// So many pairs are listed before those that are there twice go, and as many again as are left.
constexpr std::size_t kListed = 1 << 20;

void sort_once(std::vector<std::pair<int, int>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

void JoinedPairs::find(const SomeElements& elements, const std::vector<int>& first) {
  std::size_t most = kListed;
  for (std::size_t e = 0; e + 1 < elements.starts.size(); ++e) {
    const auto* begin = elements.nodes.data() + (elements.starts[e] - elements.starts.front());
    const auto* end = elements.nodes.data() + (elements.starts[e + 1] - elements.starts.front());
    for (const int* a = begin; a < end; ++a) {
      for (const int* b = begin; b < end; ++b) {
        if (*a != *b) pairs.emplace_back(*a, *b);
      }
    }
    if (pairs.size() < most) continue;
    sort_once(pairs);  // elements have most of them in common
    most = 2 * pairs.size() + kListed;
  }
  sort_once(pairs);
  counts.assign(first.size() - 1, 0);
  for (const auto& pair : pairs) {
    const auto owner = std::upper_bound(first.begin(), first.end(), pair.first) - first.begin() - 1;
    counts[static_cast<std::size_t>(owner)] += 2;
  }
}

void MeshShare::join(const std::vector<int>& numbers, int first) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(numbers.size() / 2);
  for (std::size_t k = 0; k < numbers.size(); k += 2) {
    pairs.emplace_back(numbers[k] - first, numbers[k + 1]);
  }
  sort_once(pairs);
  starts.assign(weights.size() + 1, 0);
  neighbours.clear();
  neighbours.reserve(pairs.size());
  for (const auto& [node, other] : pairs) {
    ++starts[static_cast<std::size_t>(node) + 1];
    neighbours.push_back(other);
  }
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
}

}  // namespace buckens_petsc
