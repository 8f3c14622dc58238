// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/part_selection.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::fem {

namespace {

bool same_name(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::toupper(static_cast<unsigned char>(x)) ==
           std::toupper(static_cast<unsigned char>(y));
  });
}

/// Entry with exactly this name, else one that differs in capitals only, else null.
template <class Named>
const Named* find_called(const std::vector<Named>& all, const std::string& name) {
  const Named* near = nullptr;
  for (const Named& entry : all) {
    if (entry.name == name) return &entry;
    if (near == nullptr && same_name(entry.name, name)) near = &entry;
  }
  return near;
}

class Selection {
 public:
  explicit Selection(const ImportedMesh& mesh) : mesh_(mesh) {}

  ImportedMesh run(const std::vector<std::string>& names) {
    choose_elements(names);
    choose_nodes();
    keep_joined(mesh_.rigid_links);
    keep_joined(mesh_.averages);
    keep_joined(mesh_.equations);
    keep_joined(mesh_.springs);
    spread_over_links(Node::kept, Node::other);
    spread_over_links(Node::other, Node::kept);
    fill();
    return std::move(out_);
  }

 private:
  enum class Node { free, kept, other };

  void choose_elements(const std::vector<std::string>& names);
  void choose_nodes();
  void spread_over_links(Node from, Node other);
  void fill();
  void fill_nodes();
  void fill_blocks();
  void fill_sets();
  void fill_links();

  // Nodes that links and springs use; the ground, −1, is none.
  static std::vector<int> nodes_of(const ImportedRigidLink& link) {
    std::vector<int> out = link.nodes;
    out.push_back(link.reference);
    return out;
  }
  static std::vector<int> nodes_of(const ImportedAverage& link) {
    std::vector<int> out = link.nodes;
    out.push_back(link.reference);
    return out;
  }
  static std::vector<int> nodes_of(const ImportedEquation& equation) {
    std::vector<int> out;
    for (const auto& term : equation.terms) out.push_back(term.node);
    return out;
  }
  static std::vector<int> nodes_of(const ImportedSpring& spring) {
    std::vector<int> out;
    for (const int node : spring.nodes) {
      if (node >= 0) out.push_back(node);
    }
    return out;
  }

  /// Collects what links join, in the order of kinds.
  template <class Link>
  void keep_joined(const std::vector<Link>& links) {
    for (const Link& link : links) joined_.push_back(nodes_of(link));
  }

  bool is(int node, Node state) const { return nodes_[static_cast<std::size_t>(node)] == state; }
  bool has(const std::vector<int>& nodes, Node state) const {
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return is(node, state); });
  }

  /// Copies the links that stay; counts those that joined the part to the rest.
  template <class Link, class Renumber>
  void fill_links_of(const std::vector<Link>& from, std::vector<Link>& to, Renumber renumber) {
    for (const Link& link : from) {
      const std::vector<int> nodes = nodes_of(link);
      if (!has(nodes, Node::kept)) continue;
      if (has(nodes, Node::other)) {
        ++cut_;
        continue;
      }
      renumber(to.emplace_back(link));
    }
  }

  int number(int node) const { return numbers_[static_cast<std::size_t>(node)]; }
  void renumber(std::vector<int>& nodes) const {
    for (int& node : nodes) node = number(node);
  }

  const ImportedMesh& mesh_;
  ImportedMesh out_;
  std::vector<bool> is_kept_;             // per element
  std::vector<Node> nodes_;               // per node
  std::vector<std::vector<int>> joined_;  // nodes of each link
  std::vector<int> numbers_;              // per node the new one, −1: gone
  std::vector<int> elements_;             // the same per element
  int cut_ = 0;
};

void Selection::choose_elements(const std::vector<std::string>& names) {
  is_kept_.assign(static_cast<std::size_t>(mesh_.num_elements()), false);
  for (const std::string& name : names) {
    const auto* set = find_called(mesh_.element_sets, name);
    const auto* property = find_called(mesh_.properties, name);
    if (set == nullptr && property == nullptr) {
      std::vector<std::string> known;
      for (const auto& entry : mesh_.element_sets) known.push_back(entry.name);
      for (const auto& entry : mesh_.properties) known.push_back(entry.name);
      throw InputError({mesh_.file, 0, 0},
                       fmt::format("only: there is no element set, group or property \"{}\".{}",
                                   name, base::suggestion(name, known)));
    }
    if (set != nullptr) {
      for (const int element : set->elements) is_kept_[static_cast<std::size_t>(element)] = true;
      continue;
    }
    std::size_t e = 0;
    const auto wanted = static_cast<int>(property - mesh_.properties.data());
    for (const ImportedBlock& block : mesh_.blocks) {
      const auto count = static_cast<std::size_t>(block.num_elements());
      for (std::size_t k = 0; k < count; ++k) {
        if (block.property == wanted) is_kept_[e + k] = true;
      }
      e += count;
    }
  }
  if (std::none_of(is_kept_.begin(), is_kept_.end(), [](bool kept) { return kept; })) {
    throw InputError({mesh_.file, 0, 0},
                     fmt::format("only: \"{}\" has no elements", names.front()));
  }
}

void Selection::choose_nodes() {
  nodes_.assign(static_cast<std::size_t>(mesh_.num_nodes()), Node::free);
  // Nodes of both sides belong to the part, so they come last.
  for (const bool kept : {false, true}) {
    std::size_t e = 0;
    for (const ImportedBlock& block : mesh_.blocks) {
      const auto stride = static_cast<std::size_t>(num_nodes(block.kind));
      for (std::size_t k = 0; k < block.ids.size(); ++k, ++e) {
        if (is_kept_[e] != kept) continue;
        for (std::size_t i = k * stride; i < (k + 1) * stride; ++i) {
          nodes_[static_cast<std::size_t>(block.nodes[i])] = kept ? Node::kept : Node::other;
        }
      }
    }
  }
}

/// Reference nodes without elements belong to the side to which links join them, through any number
/// of links.
void Selection::spread_over_links(Node from, Node other) {
  std::vector<std::vector<std::size_t>> links_at(nodes_.size());
  std::vector<std::size_t> waiting(joined_.size());
  std::vector<bool> waits(joined_.size(), true);
  for (std::size_t k = 0; k < joined_.size(); ++k) {
    waiting[k] = k;
    for (const int node : joined_[k]) links_at[static_cast<std::size_t>(node)].push_back(k);
  }
  while (!waiting.empty()) {
    const std::size_t link = waiting.back();
    waiting.pop_back();
    waits[link] = false;
    if (!has(joined_[link], from) || has(joined_[link], other)) continue;
    for (const int node : joined_[link]) {
      Node& state = nodes_[static_cast<std::size_t>(node)];
      if (state != Node::free) continue;
      state = from;
      for (const std::size_t next : links_at[static_cast<std::size_t>(node)]) {
        if (!waits[next]) waiting.push_back(next);
        waits[next] = true;
      }
    }
  }
}

void Selection::fill() {
  out_.file = mesh_.file;
  out_.format = mesh_.format;
  out_.making = mesh_.making;
  out_.materials = mesh_.materials;
  out_.notes = mesh_.notes;
  fill_nodes();
  fill_blocks();
  fill_sets();
  fill_links();
  if (cut_ == 0) return;
  out_.notes.push_back(
      {"only: links, equations and springs that join the chosen part to the rest "
       "are left out",
       0, cut_});
}

void Selection::fill_nodes() {
  numbers_.assign(nodes_.size(), -1);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k] == Node::other) continue;
    numbers_[k] = out_.num_nodes();
    out_.node_ids.push_back(mesh_.node_ids[k]);
    out_.positions.push_back(mesh_.positions[k]);
  }
}

void Selection::fill_blocks() {
  elements_.assign(is_kept_.size(), -1);
  std::vector<int> properties(mesh_.properties.size(), -1);
  std::size_t e = 0;
  int next = 0;
  for (const ImportedBlock& block : mesh_.blocks) {
    ImportedBlock own;
    own.kind = block.kind;
    own.source = block.source;
    own.property = block.property;
    const auto stride = static_cast<std::size_t>(num_nodes(block.kind));
    for (std::size_t k = 0; k < block.ids.size(); ++k, ++e) {
      if (!is_kept_[e]) continue;
      elements_[e] = next++;
      own.ids.push_back(block.ids[k]);
      for (std::size_t i = k * stride; i < (k + 1) * stride; ++i) {
        own.nodes.push_back(number(block.nodes[i]));
      }
      if (!block.up.empty()) own.up.push_back(block.up[k]);
    }
    if (own.ids.empty()) continue;
    if (own.property >= 0) {
      int& property = properties[static_cast<std::size_t>(own.property)];
      if (property < 0) {
        property = static_cast<int>(out_.properties.size());
        out_.properties.push_back(mesh_.properties[static_cast<std::size_t>(own.property)]);
      }
      own.property = property;
    }
    out_.blocks.push_back(std::move(own));
  }
}

void Selection::fill_sets() {
  for (const ImportedNodeSet& set : mesh_.node_sets) {
    ImportedNodeSet own{set.name, {}};
    for (const int node : set.nodes) {
      if (number(node) >= 0) own.nodes.push_back(number(node));
    }
    if (!own.nodes.empty()) out_.node_sets.push_back(std::move(own));
  }
  for (const ImportedElementSet& set : mesh_.element_sets) {
    ImportedElementSet own{set.name, {}};
    for (const int element : set.elements) {
      const int place = elements_[static_cast<std::size_t>(element)];
      if (place >= 0) own.elements.push_back(place);
    }
    std::sort(own.elements.begin(), own.elements.end());
    if (!own.elements.empty()) out_.element_sets.push_back(std::move(own));
  }
  for (const ImportedFaceSet& set : mesh_.face_sets) {
    ImportedFaceSet own{set.name, {}};
    for (const ImportedFace& face : set.faces) {
      const int place = elements_[static_cast<std::size_t>(face.element)];
      if (place < 0) continue;
      own.faces.push_back({place, face.corners});
      renumber(own.faces.back().corners);
    }
    if (!own.faces.empty()) out_.face_sets.push_back(std::move(own));
  }
}

void Selection::fill_links() {
  const auto with_reference = [this](auto& link) {
    link.reference = number(link.reference);
    renumber(link.nodes);
  };
  fill_links_of(mesh_.rigid_links, out_.rigid_links, with_reference);
  fill_links_of(mesh_.averages, out_.averages, with_reference);
  fill_links_of(mesh_.equations, out_.equations, [this](ImportedEquation& equation) {
    for (auto& term : equation.terms) term.node = number(term.node);
  });
  fill_links_of(mesh_.springs, out_.springs, [this](ImportedSpring& spring) {
    for (int& node : spring.nodes) node = node < 0 ? node : number(node);
  });
  for (const ImportedMass& mass : mesh_.masses) {
    if (!is(mass.node, Node::kept)) continue;
    out_.masses.push_back(mass);
    out_.masses.back().node = number(mass.node);
  }
}

}  // namespace

ImportedMesh only_part(const ImportedMesh& mesh, const std::vector<std::string>& names) {
  return Selection(mesh).run(names);
}

}  // namespace buckens::fem
