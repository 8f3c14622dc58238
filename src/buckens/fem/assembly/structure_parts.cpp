// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/structure_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/graph_partition.h"

namespace buckens::fem {

namespace {

/// A beam, bar, solid or shell: what holds nodes together.
struct Holder {
  std::span<const int> nodes;
  double length;  // of a solid or shell: from its first to its opposite corner
};

std::vector<Holder> holders_of(const Structure& structure) {
  std::vector<Holder> out;
  const auto add = [&](const ElementBlock& block) {
    for (int e = 0; e < block.num_elements(); ++e) {
      const std::span<const int> nodes = block.nodes(e);
      Eigen::AlignedBox3d box;
      for (const int node : nodes) {
        box.extend(structure.nodes.at(static_cast<std::size_t>(node)).position);
      }
      out.push_back({nodes, box.diagonal().norm()});
    }
  };
  add(structure.beams);
  add(structure.bars);
  add(structure.solids);
  add(structure.shells);
  return out;
}

std::vector<std::vector<int>> holders_at_nodes(std::size_t num_nodes,
                                               const std::vector<Holder>& holders) {
  std::vector<std::vector<int>> out(num_nodes);
  for (std::size_t e = 0; e < holders.size(); ++e) {
    for (const int node : holders[e].nodes) {
      out[static_cast<std::size_t>(node)].push_back(static_cast<int>(e));
    }
  }
  return out;
}

/// The elements in the order in which they follow one another, if they form one open line.
std::optional<std::vector<int>> as_chain(const std::vector<Holder>& lines,
                                         const std::vector<std::vector<int>>& at_node) {
  const auto is_line = [](const Holder& holder) { return holder.nodes.size() == 2; };
  if (!std::all_of(lines.begin(), lines.end(), is_line)) return std::nullopt;
  int node = -1;
  for (std::size_t k = 0; k < at_node.size(); ++k) {
    if (at_node[k].size() > 2) return std::nullopt;
    if (at_node[k].size() == 1 && node < 0) node = static_cast<int>(k);
  }
  if (node < 0) return std::nullopt;
  std::vector<int> chain;
  std::vector<bool> used(lines.size(), false);
  for (bool found = true; found;) {
    found = false;
    for (const int e : at_node[static_cast<std::size_t>(node)]) {
      if (used[static_cast<std::size_t>(e)]) continue;
      const auto& ends = lines[static_cast<std::size_t>(e)].nodes;
      used[static_cast<std::size_t>(e)] = found = true;
      chain.push_back(e);
      node = ends[0] == node ? ends[1] : ends[0];
      break;
    }
  }
  if (chain.size() != lines.size()) return std::nullopt;
  return chain;
}

std::vector<int> divide_chain(const std::vector<Holder>& lines, const std::vector<int>& chain,
                              int count) {
  double total = 0.0;
  for (const Holder& line : lines) total += line.length;
  std::vector<int> part_of(lines.size());
  double passed = 0.0;
  int part = 0;
  const int last = static_cast<int>(chain.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    const Holder& line = lines[static_cast<std::size_t>(chain[static_cast<std::size_t>(k)])];
    const double middle = (passed + 0.5 * line.length) / total;
    const int wanted = std::min(count - 1, static_cast<int>(middle * count));
    // Every part gets an element: at most one new part each, and enough left for the rest.
    part = k == 0 ? 0 : std::clamp(wanted, part, part + 1);
    part = std::max(part, count - 1 - (last - k));
    part_of[static_cast<std::size_t>(chain[static_cast<std::size_t>(k)])] = part;
    passed += line.length;
  }
  return part_of;
}

using Pair = std::pair<int, int>;  // of elements, the lower number first
/// Pairs of elements that share nodes, and how many.
using Pairs = std::map<Pair, int>;

Pairs node_pairs(const std::vector<std::vector<int>>& at_node) {
  Pairs out;
  for (const auto& list : at_node) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t j = i + 1; j < list.size(); ++j) ++out[{list[i], list[j]}];
    }
  }
  return out;
}

/// Pairs of solids that share a face.
std::set<Pair> face_neighbours(const Structure& structure) {
  const int lines = structure.beams.num_elements() + structure.bars.num_elements();
  std::map<std::array<int, 4>, int> seen;  // element that was met with the face
  std::set<Pair> out;
  for (int e = 0; e < structure.solids.num_elements(); ++e) {
    for (std::array<int, 4> face : structure.solids.faces(e)) {
      std::sort(face.begin(), face.end());
      const auto [entry, is_new] = seen.emplace(face, lines + e);
      if (!is_new) out.emplace(entry->second, lines + e);
    }
  }
  return out;
}

bool is_connected(const linalg::Graph& graph) {
  std::vector<int> parent(graph.vertex_weights.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      int& up = parent[static_cast<std::size_t>(v)];
      up = parent[static_cast<std::size_t>(up)];  // halves the way of those that come later
      v = up;
    }
    return v;
  };
  std::size_t pieces = parent.size();
  for (const auto& [a, b] : graph.edges) {
    const int ra = root(a);
    const int rb = root(b);
    if (ra == rb) continue;
    parent[static_cast<std::size_t>(rb)] = ra;
    --pieces;
  }
  return pieces <= 1;
}

/// The elements and their connections: solids by their faces, lines
/// and shells by their nodes. With `faces` null every common node
/// counts.
linalg::Graph graph_of(const std::vector<Holder>& holders, std::size_t first_shell,
                       const Pairs& pairs, const std::set<Pair>* faces) {
  linalg::Graph graph;
  for (const Holder& holder : holders) graph.vertex_weights.push_back(holder.length);
  const auto turns = [&](int e) {
    const auto k = static_cast<std::size_t>(e);
    return holders[k].nodes.size() == 2 || k >= first_shell;
  };
  for (const auto& [pair, count] : pairs) {
    const bool holds =
        faces == nullptr || faces->contains(pair) || turns(pair.first) || turns(pair.second);
    for (int k = 0; k < count && holds; ++k) graph.edges.push_back(pair);
  }
  return graph;
}

/// Makes the parts one after the other.
class Divider {
 public:
  Divider(const Structure& whole, const std::vector<int>& part_of)
      : whole_(whole), part_of_(part_of), shells_(whole.shells) {
    shells_.choose_directors(whole.nodes);  // parts keep those of the whole
    const int count = 1 + *std::max_element(part_of.begin(), part_of.end());
    out_.parts.resize(static_cast<std::size_t>(count));
    out_.nodes.resize(whole.nodes.size());
    own_.resize(out_.parts.size());
    number_.assign(whole.nodes.size(), -1);
  }

  StructureParts run() {
    const int beams = whole_.beams.num_elements();
    const int lines = beams + whole_.bars.num_elements();
    const int solids = whole_.solids.num_elements();
    for (std::size_t e = 0; e < part_of_.size(); ++e) {
      Elements& own = own_[static_cast<std::size_t>(part_of_[e])];
      const int element = static_cast<int>(e);
      if (element < beams) {
        own.beams.push_back(element);
      } else if (element < lines) {
        own.bars.push_back(element - beams);
      } else if (element < lines + solids) {
        own.solids.push_back(element - lines);
      } else {
        own.shells.push_back(element - lines - solids);
      }
    }
    out_.lines.resize(static_cast<std::size_t>(lines));
    out_.solids.resize(static_cast<std::size_t>(solids + whole_.shells.num_elements()));
    for (std::size_t p = 0; p < out_.parts.size(); ++p) add_elements(static_cast<int>(p));
    for (int m = 0; m < whole_.masses.num_elements(); ++m) add_mass(m);
    return std::move(out_);
  }

 private:
  struct Elements {
    std::vector<int> beams, bars, solids, shells;
  };

  void add_elements(int p) {
    Structure& part = out_.parts[static_cast<std::size_t>(p)];
    const Elements& own = own_[static_cast<std::size_t>(p)];
    const int beams = whole_.beams.num_elements();
    std::vector<int> nodes;
    const auto collect = [&](const ElementBlock& block, int element) {
      const auto of_element = block.nodes(element);
      nodes.insert(nodes.end(), of_element.begin(), of_element.end());
    };
    int line = 0;
    int solid = 0;
    for (const int e : own.beams) {
      collect(whole_.beams, e);
      out_.lines[static_cast<std::size_t>(e)] = {p, line++};
    }
    for (const int e : own.bars) {
      collect(whole_.bars, e);
      out_.lines[static_cast<std::size_t>(beams + e)] = {p, line++};
    }
    for (const int e : own.solids) {
      collect(whole_.solids, e);
      out_.solids[static_cast<std::size_t>(e)] = {p, solid++};
    }
    for (const int e : own.shells) {
      collect(whole_.shells, e);
      out_.solids[static_cast<std::size_t>(whole_.solids.num_elements() + e)] = {p, solid++};
    }
    add_nodes(p, nodes);
    part.beams = whole_.beams.subset(own.beams, number_);
    part.bars = whole_.bars.subset(own.bars, number_);
    part.solids = whole_.solids.subset(own.solids, number_);
    part.shells = shells_.subset(own.shells, number_);
  }

  /// Copies the nodes of one part, in the order of the whole mesh.
  void add_nodes(int p, std::vector<int>& nodes) {
    Structure& part = out_.parts[static_cast<std::size_t>(p)];
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const int node : nodes) {
      const auto n = static_cast<std::size_t>(node);
      number_[n] = static_cast<int>(part.nodes.size());
      out_.nodes[n].push_back({p, number_[n]});
      part.nodes.push_back(whole_.nodes[n]);
    }
  }

  void add_mass(int mass) {
    const auto node = static_cast<std::size_t>(whole_.masses.ends(mass)[0]);
    const PartPlace at = out_.nodes.at(node).at(0);
    out_.parts[static_cast<std::size_t>(at.part)].masses.add(at.index, whole_.masses.mass(mass),
                                                             whole_.masses.inertia(mass));
  }

  const Structure& whole_;
  const std::vector<int>& part_of_;
  StructureParts out_;
  std::vector<Elements> own_;
  ShellBlock shells_;
  std::vector<int> number_;  // of each node in the part at work
};

}  // namespace

int num_holding_elements(const Structure& structure) {
  return structure.beams.num_elements() + structure.bars.num_elements() +
         structure.solids.num_elements() + structure.shells.num_elements();
}

std::vector<int> choose_parts(const Structure& structure, int count) {
  const std::vector<Holder> holders = holders_of(structure);
  const auto most = static_cast<int>(holders.size());
  if (count < 1 || count > most) {
    throw ModelError(
        fmt::format("{} frames for {} elements; every frame carries at least one element: use "
                    "fewer frames or more elements",
                    count, most));
  }
  const auto at_node = holders_at_nodes(structure.nodes.size(), holders);
  if (const auto chain = as_chain(holders, at_node)) return divide_chain(holders, *chain, count);
  const Pairs pairs = node_pairs(at_node);
  // Solids that share only an edge or a node could rotate about it: such pairs only count if the
  // mesh would fall apart without them.
  const std::set<Pair> faces = face_neighbours(structure);
  const std::size_t first_shell =
      holders.size() - static_cast<std::size_t>(structure.shells.num_elements());
  const linalg::Graph by_faces = graph_of(holders, first_shell, pairs, &faces);
  if (is_connected(by_faces)) return linalg::divide_graph(by_faces, count);
  return linalg::divide_graph(graph_of(holders, first_shell, pairs, nullptr), count);
}

StructureParts divide(const Structure& structure, const std::vector<int>& part_of) {
  return Divider(structure, part_of).run();
}

}  // namespace buckens::fem
