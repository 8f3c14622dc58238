// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/connection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <unordered_map>

#include <Eigen/Geometry>

namespace buckens::fem {

namespace {

/// Union of parts, with paths halved on the way.
class Parts {
 public:
  explicit Parts(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int node) {
    int* p = parent_.data();
    while (p[node] != node) node = p[node] = p[p[node]];
    return node;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(root(a))] = root(b); }

 private:
  std::vector<int> parent_;
};

/// Calls `visit(nodes, has_rotations)` for everything that uses nodes.
template <class Visit>
void for_each_user(const ImportedMesh& mesh, Visit visit) {
  for (const ImportedBlock& block : mesh.blocks) {
    const int count = num_nodes(block.kind);
    const bool is_bar =
        block.property >= 0 &&
        mesh.properties[static_cast<std::size_t>(block.property)].kind == PropertyKind::bar;
    const int dimension = dimension_of(block.kind);
    for (int e = 0; e < block.num_elements(); ++e) {
      const int* first = block.nodes.data() + static_cast<std::ptrdiff_t>(e) * count;
      visit(std::span(first, static_cast<std::size_t>(count)),
            dimension < 3 && dimension > 0 && !is_bar);
    }
  }
  for (const ImportedMass& mass : mesh.masses) visit(std::span(&mass.node, 1), false);
  for (const ImportedSpring& spring : mesh.springs) {
    std::vector<int> ends;  // the ground is no node
    std::copy_if(spring.nodes.begin(), spring.nodes.end(), std::back_inserter(ends),
                 [](int node) { return node >= 0; });
    if (!ends.empty()) visit(std::span<const int>(ends), false);
  }
  const auto with_reference = [&](int reference, std::vector<int> nodes) {
    nodes.push_back(reference);
    visit(std::span<const int>(nodes), false);
  };
  for (const ImportedRigidLink& link : mesh.rigid_links) with_reference(link.reference, link.nodes);
  for (const ImportedAverage& mean : mesh.averages) with_reference(mean.reference, mean.nodes);
  for (const ImportedEquation& equation : mesh.equations) {
    std::vector<int> nodes;
    for (const auto& term : equation.terms) nodes.push_back(term.node);
    if (!nodes.empty()) visit(std::span<const int>(nodes), false);
  }
}

using GridCell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const GridCell& cell) const {
    std::uint64_t out = 1469598103934665603U;
    for (const std::int64_t k : cell) {
      out = (out ^ static_cast<std::uint64_t>(k)) * 1099511628211U;
      out ^= out >> 31;
    }
    return out;
  }
};

}  // namespace

MeshConnection connect(const ImportedMesh& mesh) {
  Parts parts(mesh.num_nodes());
  std::vector<int> variables(static_cast<std::size_t>(mesh.num_nodes()), 0);
  for_each_user(mesh, [&](std::span<const int> nodes, bool has_rotations) {
    for (const int node : nodes) {
      parts.join(node, nodes.front());
      int& own = variables[static_cast<std::size_t>(node)];
      own = std::max(own, has_rotations ? 6 : 3);
    }
  });
  MeshConnection out;
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    const int own = variables[static_cast<std::size_t>(node)];
    out.variables += own;
    if (own == 0) {
      out.free_nodes.push_back(node);
    } else if (parts.root(node) == node) {
      ++out.pieces;  // links only join used nodes, so that one of them represents each piece
    }
  }
  return out;
}

std::vector<std::pair<int, int>> coincident_nodes(const ImportedMesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.num_nodes()), false);
  Eigen::AlignedBox3d box;
  for_each_user(mesh, [&](std::span<const int> nodes, bool) {
    for (const int node : nodes) {
      used[static_cast<std::size_t>(node)] = true;
      box.extend(mesh.positions[static_cast<std::size_t>(node)]);
    }
  });
  std::vector<std::pair<int, int>> out;
  if (box.isEmpty() || !(box.diagonal().norm() > 0)) return out;
  const double tolerance = 1e-6 * box.diagonal().norm();
  // Nodes that are so close share a cell, or each lies by the border of its own. Cells are wider
  // than the tolerance and begin beside the box, so that few nodes lie by a border.
  const double width = 8.0 * tolerance;
  const Eigen::Vector3d origin = box.min() - Eigen::Vector3d::Constant(0.381966 * width);
  constexpr int kNone = -1;
  std::unordered_map<GridCell, int, CellHash> cells;                           // last node in it
  std::vector<int> before(static_cast<std::size_t>(mesh.num_nodes()), kNone);  // in the same cell
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    if (!used[static_cast<std::size_t>(node)]) continue;
    const Eigen::Vector3d& x = mesh.positions[static_cast<std::size_t>(node)];
    GridCell cell, least, most;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at =
          (x[static_cast<Eigen::Index>(k)] - origin[static_cast<Eigen::Index>(k)]) / width;
      cell[k] = static_cast<std::int64_t>(std::floor(at));
      least[k] = static_cast<std::int64_t>(std::floor(at - 0.126));  // a tolerance is 1/8
      most[k] = static_cast<std::int64_t>(std::floor(at + 0.126));
    }
    const auto compare_with = [&](const GridCell& near) {
      const auto found = cells.find(near);
      for (int other = found == cells.end() ? kNone : found->second; other != kNone;
           other = before[static_cast<std::size_t>(other)]) {
        const auto& y = mesh.positions[static_cast<std::size_t>(other)];
        if ((x - y).norm() <= tolerance) out.emplace_back(other, node);
      }
    };
    GridCell near;
    for (near[0] = least[0]; near[0] <= most[0]; ++near[0]) {
      for (near[1] = least[1]; near[1] <= most[1]; ++near[1]) {
        for (near[2] = least[2]; near[2] <= most[2]; ++near[2]) compare_with(near);
      }
    }
    // One node represents all at a position, so that many at one position cost no more than their
    // number.
    if (!out.empty() && out.back().second == node) continue;
    const auto [entry, is_new] = cells.try_emplace(cell, node);
    if (is_new) continue;
    before[static_cast<std::size_t>(node)] = entry->second;
    entry->second = node;
  }
  return out;
}

}  // namespace buckens::fem
