// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/least_degree.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace buckens::linalg {

namespace {

/// Vertices still to be eliminated and who is coupled with whom.
class WaitingGraph {
 public:
  WaitingGraph(std::size_t count, const std::vector<std::pair<int, int>>& couples)
      : coupled_(count), degree_(count, 0), is_gone_(count, false), is_clique_(count, false) {
    for (const auto& [i, j] : couples) {
      if (i == j) continue;
      coupled_[static_cast<std::size_t>(i)].push_back(j);
      coupled_[static_cast<std::size_t>(j)].push_back(i);
    }
    for (std::size_t k = 0; k < count; ++k) {
      auto& list = coupled_[k];
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      degree_[k] = list.size();
      waiting_.emplace(degree_[k], static_cast<int>(k));
    }
  }

  bool empty() const { return waiting_.empty(); }

  EliminationStep take() {
    const int vertex = waiting_.begin()->second;
    const auto v = static_cast<std::size_t>(vertex);
    waiting_.erase(waiting_.begin());
    is_gone_[v] = true;
    std::vector<int> others = std::move(coupled_[v]);
    std::erase_if(others, [&](int k) { return is_gone_[static_cast<std::size_t>(k)]; });
    for (const int k : others) {
      const auto i = static_cast<std::size_t>(k);
      waiting_.erase({degree_[i], k});
      if (is_clique_[v] || has_all(i, others)) {
        --degree_[i];
      } else {
        couple(i, others);
      }
      // Whose neighbours are no more than these will find them coupled.
      is_clique_[i] = degree_[i] + 1 == others.size();
      waiting_.emplace(degree_[i], k);
    }
    return {vertex, std::move(others)};
  }

 private:
  /// Whether vertex i is coupled with all others.
  bool has_all(std::size_t i, const std::vector<int>& others) const {
    const auto& list = coupled_[i];
    return std::all_of(others.begin(), others.end(), [&](int k) {
      return k == static_cast<int>(i) || std::binary_search(list.begin(), list.end(), k);
    });
  }

  /// Adds `others` to what vertex i is coupled with. Both are ascending.
  void couple(std::size_t i, const std::vector<int>& others) {
    std::vector<int> united;
    united.reserve(coupled_[i].size() + others.size());
    std::set_union(coupled_[i].begin(), coupled_[i].end(), others.begin(), others.end(),
                   std::back_inserter(united));
    std::erase_if(united, [&](int k) {
      return is_gone_[static_cast<std::size_t>(k)] || k == static_cast<int>(i);
    });
    degree_[i] = united.size();
    coupled_[i] = std::move(united);
  }

  std::vector<std::vector<int>> coupled_;  // ascending; some may be gone
  std::vector<std::size_t> degree_;        // without those
  std::vector<bool> is_gone_;
  std::vector<bool> is_clique_;                    // its neighbours are coupled with each other
  std::set<std::pair<std::size_t, int>> waiting_;  // (degree, vertex)
};

}  // namespace

std::vector<EliminationStep> eliminate_by_least_degree(
    std::size_t count, const std::vector<std::pair<int, int>>& couples) {
  WaitingGraph graph(count, couples);
  std::vector<EliminationStep> out;
  out.reserve(count);
  while (!graph.empty()) out.push_back(graph.take());
  return out;
}

}  // namespace buckens::linalg
