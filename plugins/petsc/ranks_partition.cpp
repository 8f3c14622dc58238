// SPDX-License-Identifier: Apache-2.0
// How the nodes of a mesh are divided among the processes other than the first: by PT-Scotch, from
// the graph of nodes that elements join, of which each process has a share.
#include <cstdint>
#include <cstdio>
#include <type_traits>
#include <utility>
#include <vector>

#include <ptscotch.h>

#include "mesh_share.h"
#include "ranks_messages.h"
#include "ranks_parts.h"

namespace buckens_petsc {

namespace {

// Parts may be heavier than their mean by so much.
constexpr double kImbalance = 0.01;

/// Objects of PT-Scotch for one partition.
class Partition {
 public:
  explicit Partition(MPI_Comm comm) {
    has_begun_ = SCOTCH_contextInit(&context_) == 0 && SCOTCH_dgraphInit(&graph_, comm) == 0 &&
                 SCOTCH_dgraphInit(&bound_, comm) == 0 && SCOTCH_stratInit(&strategy_) == 0;
  }
  ~Partition() {
    if (!has_begun_) return;
    SCOTCH_stratExit(&strategy_);
    SCOTCH_dgraphExit(&bound_);
    SCOTCH_dgraphExit(&graph_);
    SCOTCH_contextExit(&context_);
  }
  Partition(const Partition&) = delete;
  Partition& operator=(const Partition&) = delete;

  /// @param part gets the part of each node here
  bool find(MeshShare& mesh, int parts, std::vector<SCOTCH_Num>& part) {
    const auto nodes = static_cast<SCOTCH_Num>(mesh.weights.size());
    const auto edges = static_cast<SCOTCH_Num>(mesh.neighbours.size());
    part.resize(mesh.weights.size());
    static_assert(std::is_same_v<SCOTCH_Num, int>);
    if (!has_begun_) return false;
    // One thread and the same numbers at random: the same parts in each run.
    SCOTCH_contextRandomSeed(&context_, 1);
    return SCOTCH_contextThreadSpawn(&context_, 1, nullptr) == 0 &&
           SCOTCH_contextOptionSetNum(&context_, SCOTCH_OPTIONNUMDETERMINISTIC, 1) == 0 &&
           SCOTCH_dgraphBuild(&graph_, 0, nodes, nodes, mesh.starts.data(), nullptr,
                              mesh.weights.data(), nullptr, edges, edges, mesh.neighbours.data(),
                              nullptr, nullptr) == 0 &&
           SCOTCH_contextBindDgraph(&context_, &graph_, &bound_) == 0 &&
           SCOTCH_stratDgraphMapBuild(&strategy_, SCOTCH_STRATQUALITY, parts, parts, kImbalance) ==
               0 &&
           SCOTCH_dgraphPart(&bound_, parts, &strategy_, part.data()) == 0;
  }

 private:
  bool has_begun_ = false;
  SCOTCH_Context context_{};
  SCOTCH_Dgraph graph_{}, bound_{};
  SCOTCH_Strat strategy_{};
};

}  // namespace

bool Ranks::partition(const BuckensGridMesh& mesh, int* part) {
  Order order;
  order.task = Task::partition;
  order.size = mesh.num_nodes;
  give(order);
  return partition_together(order, &mesh, part);
}

/// Of the first: each of the others gets as many elements as any other, with its share of weights.
/// @return whether all have room for them
bool Ranks::send_mesh(const BuckensGridMesh& mesh, const std::vector<int>& first) {
  const auto element = [&](int k) { return mesh.num_elements * (k - 1) / (count_ - 1); };
  for (int k = 1; k < count_; ++k) {
    const long from = element(k), end = element(k + 1);
    const long sizes[2] = {end - from, mesh.starts[end] - mesh.starts[from]};
    send_counted(sizes, 2, k);
  }
  if (has_failed_somewhere(false)) return false;
  for (int k = 1; k < count_; ++k) {
    const long from = element(k), end = element(k + 1);
    const auto nodes = static_cast<std::size_t>(mesh.starts[end] - mesh.starts[from]);
    send_counted(mesh.starts + from, static_cast<std::size_t>(end - from) + 1, k);
    send_counted(mesh.nodes + mesh.starts[from], nodes, k);
    send_counted(mesh.weights + first[k], static_cast<std::size_t>(first[k + 1] - first[k]), k);
  }
  return true;
}

/// Of the others: what send_mesh() sends.
bool Ranks::receive_mesh(int nodes, SomeElements& elements, MeshShare& own) {
  long sizes[2] = {};
  receive(sizes, 2, 0, work_);
  const bool has_room = has_memory_for([&] {
    elements.starts.resize(static_cast<std::size_t>(sizes[0]) + 1);
    elements.nodes.resize(static_cast<std::size_t>(sizes[1]));
    own.weights.resize(static_cast<std::size_t>(nodes));
  });
  if (has_failed_somewhere(!has_room)) return false;
  receive(elements.starts.data(), elements.starts.size(), 0, work_);
  receive(elements.nodes.data(), elements.nodes.size(), 0, work_);
  receive(own.weights.data(), own.weights.size(), 0, work_);
  return true;
}

bool Ranks::partition_together(const Order& order, const BuckensGridMesh* mesh, int* part) {
  std::vector<int> first = {0};
  for (int k = 0; k < count_; ++k) {
    first.push_back(static_cast<int>(static_cast<long>(order.size) * k / (count_ - 1)));
  }
  SomeElements elements;
  MeshShare own;
  const bool has_mesh = mesh != nullptr
                            ? send_mesh(*mesh, first)
                            : receive_mesh(first[rank_ + 1] - first[rank_], elements, own);
  if (!has_mesh || !share_mesh(first, elements, own)) return false;
  std::vector<SCOTCH_Num> found;
  bool is_found = true;
  if (rank_ != 0) {
    is_found = Partition(others_).find(own, count_ - 1, found);
    if (!is_found) set_reason("PT-Scotch could not divide the graph of its nodes");
  }
  if (has_failed_somewhere(!is_found)) return false;
  std::vector<int> counts;
  for (int k = 0; k < count_; ++k) counts.push_back(first[k + 1] - first[k]);
  MPI_Gatherv(found.data(), counts[rank_], MPI_INT, part, counts.data(), first.data(), MPI_INT, 0,
              work_);
  count_messages(count_ - 1, 0);
  traffic_.bytes += sizeof(int) * static_cast<double>(order.size);
  return true;
}

/// Of all: the others find the pairs of nodes that their elements join, and give each to those who
/// have its nodes.
bool Ranks::share_mesh(const std::vector<int>& first, const SomeElements& elements,
                       MeshShare& own) {
  const bool works = rank_ != 0;
  JoinedPairs joined;
  std::vector<int> in;
  const auto all_have_memory = [&](auto&& action) {
    return !has_failed_somewhere(works && !has_memory_for(action));
  };
  // Ranks of those who work begin with 0.
  const std::vector<int> of_others(first.begin() + 1, first.end());
  if (!all_have_memory([&] { joined.find(elements, of_others); })) return false;
  std::vector<int> in_counts(joined.counts.size());
  if (works) {
    MPI_Alltoall(joined.counts.data(), 1, MPI_INT, in_counts.data(), 1, MPI_INT, others_);
  }
  const std::vector<int> in_first = starts_of(in_counts);
  if (!all_have_memory([&] { in.resize(static_cast<std::size_t>(in_first.back())); })) return false;
  if (works) {
    static_assert(sizeof(std::pair<int, int>) == 2 * sizeof(int));
    const std::vector<int> out_first = starts_of(joined.counts);
    MPI_Alltoallv(joined.pairs.data(), joined.counts.data(), out_first.data(), MPI_INT, in.data(),
                  in_counts.data(), in_first.data(), MPI_INT, others_);
  }
  joined = {};
  return all_have_memory([&] { own.join(in, first[rank_]); });
}

}  // namespace buckens_petsc
