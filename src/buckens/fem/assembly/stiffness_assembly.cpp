// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/stiffness_assembly.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "buckens/fem/assembly/element_pieces.h"

namespace buckens::fem {

using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

using ElementBlocks = std::vector<std::shared_ptr<const ElementBlock>>;

/// The nodes that share an element with a node, itself included.
class NodeNeighbours {
 public:
  NodeNeighbours(const ElementBlocks& blocks, std::size_t num_nodes)
      : first_(num_nodes + 1, 0), seen_from_(num_nodes, -1) {
    for (const auto& block : blocks) {
      for (int e = 0; e < block->num_elements(); ++e) elements_.push_back(block->nodes(e));
    }
    for (const auto& nodes : elements_) {
      for (const int node : nodes) ++first_[static_cast<std::size_t>(node) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    at_node_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      for (const int node : elements_[e]) at_node_[next[static_cast<std::size_t>(node)]++] = e;
    }
  }

  /// Ascending, until the next call.
  const std::vector<int>& of(int node) {
    found_.clear();
    const auto k = static_cast<std::size_t>(node);
    for (std::size_t place = first_[k]; place < first_[k + 1]; ++place) {
      for (const int other : elements_[at_node_[place]]) {
        int& from = seen_from_[static_cast<std::size_t>(other)];
        if (from == node) continue;
        from = node;
        found_.push_back(other);
      }
    }
    for (const int other : found_) seen_from_[static_cast<std::size_t>(other)] = -1;
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  std::vector<std::span<const int>> elements_;
  std::vector<std::size_t> first_, at_node_;
  std::vector<int> seen_from_, found_;
};

template <class Visitor>
void visit_variables(const DofMap& dofs, int node, Visitor&& visit) {
  for (const int dof : dofs.node_dofs[static_cast<std::size_t>(node)]) {
    if (dof >= 0) visit(dof);
  }
}

}  // namespace

EntrySums::EntrySums(const ElementBlocks& blocks, const DofMap& dofs)
    : sums_(dofs.num_dofs, dofs.num_dofs) {
  NodeNeighbours neighbours(blocks, dofs.node_dofs.size());
  int* starts = sums_.outerIndexPtr();
  starts[0] = 0;
  const auto num_nodes = static_cast<int>(dofs.node_dofs.size());
  for (int node = 0; node < num_nodes; ++node) {
    int rows = 0;
    for (const int other : neighbours.of(node)) visit_variables(dofs, other, [&](int) { ++rows; });
    visit_variables(dofs, node, [&](int dof) { starts[dof + 1] = starts[dof] + rows; });
  }
  sums_.resizeNonZeros(starts[dofs.num_dofs]);
  std::fill_n(sums_.valuePtr(), sums_.nonZeros(), 0.0);
  has_entry_.resize(static_cast<std::size_t>(sums_.nonZeros()), false);
  for (int node = 0; node < num_nodes; ++node) {
    const std::vector<int>& others = neighbours.of(node);
    visit_variables(dofs, node, [&](int dof) {
      int* row = sums_.innerIndexPtr() + starts[dof];
      for (const int other : others) visit_variables(dofs, other, [&row](int k) { *row++ = k; });
    });
  }
}

void EntrySums::add(std::span<const Triplet> entries) {
  const int* rows = sums_.innerIndexPtr();
  for (const Triplet& entry : entries) {
    const int* first = rows + sums_.outerIndexPtr()[entry.col()];
    const int* last = rows + sums_.outerIndexPtr()[entry.col() + 1];
    const auto place = std::lower_bound(first, last, entry.row()) - rows;
    sums_.valuePtr()[place] += entry.value();
    has_entry_[static_cast<std::size_t>(place)] = true;
  }
}

SparseMatrix EntrySums::take() {
  int* starts = sums_.outerIndexPtr();
  int kept = 0;
  int place = 0;
  for (Eigen::Index column = 0; column < sums_.cols(); ++column) {
    for (const int end = starts[column + 1]; place < end; ++place) {
      if (!has_entry_[static_cast<std::size_t>(place)]) continue;
      sums_.innerIndexPtr()[kept] = sums_.innerIndexPtr()[place];
      sums_.valuePtr()[kept++] = sums_.valuePtr()[place];
    }
    starts[column + 1] = kept;
  }
  sums_.resizeNonZeros(kept);
  SparseMatrix out;
  out.swap(sums_);
  has_entry_ = {};
  return out;
}

StiffnessMatrices assemble_stiffness(const ElementBlocks& blocks, const MeshView& mesh) {
  EntrySums K(blocks, mesh.dofs);
  std::optional<EntrySums> K_damping;
  for (const auto& block : blocks) {
    visit_pieces(*block, mesh.nodes, [&](const ElementBlock& piece, int) {
      StiffnessSum listed;
      piece.add_stiffness(mesh, listed);
      K.add(listed.K);
      if (listed.K_damping.empty()) return;
      if (!K_damping) K_damping.emplace(blocks, mesh.dofs);
      K_damping->add(listed.K_damping);
    });
  }
  SparseMatrix undamped(mesh.dofs.num_dofs, mesh.dofs.num_dofs);
  return {K.take(), K_damping ? K_damping->take() : undamped};
}

}  // namespace buckens::fem
