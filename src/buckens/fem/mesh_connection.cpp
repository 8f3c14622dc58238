// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh_connection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
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
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(e) * count;
      visit(std::vector<int>(first, first + count), dimension < 3 && dimension > 0 && !is_bar);
    }
  }
  for (const ImportedMass& mass : mesh.masses) visit(std::vector<int>{mass.node}, false);
  for (const ImportedSpring& spring : mesh.springs) {
    visit(std::vector<int>(spring.nodes.begin(), spring.nodes.end()), false);
  }
  const auto with_reference = [&](int reference, std::vector<int> nodes) {
    nodes.push_back(reference);
    visit(nodes, false);
  };
  for (const ImportedRigidLink& link : mesh.rigid_links) with_reference(link.reference, link.nodes);
  for (const ImportedAverage& mean : mesh.averages) with_reference(mean.reference, mean.nodes);
  for (const ImportedEquation& equation : mesh.equations) {
    std::vector<int> nodes;
    for (const auto& term : equation.terms) nodes.push_back(term.node);
    if (!nodes.empty()) visit(nodes, false);
  }
}

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
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
  for_each_user(mesh, [&](const std::vector<int>& nodes, bool has_rotations) {
    for (const int node : nodes) {
      parts.join(node, nodes.front());
      int& own = variables[static_cast<std::size_t>(node)];
      own = std::max(own, has_rotations ? 6 : 3);
    }
  });
  MeshConnection out;
  std::set<int> roots;
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    const int own = variables[static_cast<std::size_t>(node)];
    out.variables += own;
    if (own == 0) {
      out.free_nodes.push_back(node);
    } else {
      roots.insert(parts.root(node));
    }
  }
  out.pieces = static_cast<int>(roots.size());
  return out;
}

std::vector<std::pair<int, int>> coincident_nodes(const ImportedMesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.num_nodes()), false);
  Eigen::AlignedBox3d box;
  for_each_user(mesh, [&](const std::vector<int>& nodes, bool) {
    for (const int node : nodes) {
      used[static_cast<std::size_t>(node)] = true;
      box.extend(mesh.positions[static_cast<std::size_t>(node)]);
    }
  });
  std::vector<std::pair<int, int>> out;
  if (box.isEmpty() || !(box.diagonal().norm() > 0)) return out;
  // Nodes that are so close share a cell or lie in neighbours of it.
  const double tolerance = 1e-6 * box.diagonal().norm();
  std::unordered_map<Cell, std::vector<int>, CellHash> cells;
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    if (!used[static_cast<std::size_t>(node)]) continue;
    const Eigen::Vector3d& x = mesh.positions[static_cast<std::size_t>(node)];
    Cell cell;
    for (int k = 0; k < 3; ++k) {
      cell[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(std::floor((x[k] - box.min()[k]) / tolerance));
    }
    for (int step = 0; step < 27; ++step) {
      const auto found =
          cells.find({cell[0] + step % 3 - 1, cell[1] + step / 3 % 3 - 1, cell[2] + step / 9 - 1});
      if (found == cells.end()) continue;
      for (const int other : found->second) {
        const auto& y = mesh.positions[static_cast<std::size_t>(other)];
        if ((x - y).norm() <= tolerance) out.emplace_back(other, node);
      }
    }
    // One node stands for all at a place, so that many at one place cost no more than their number.
    if (out.empty() || out.back().second != node) cells[cell].push_back(node);
  }
  return out;
}

}  // namespace buckens::fem
