// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_links.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/node_number.h"
#include "buckens/model/build/imported_springs.h"

namespace buckens::model {

namespace {

/// Adds one kind of link after the other.
class LinkImport {
 public:
  LinkImport(const fem::ImportedMesh& mesh, const std::vector<int>& numbers,
             const SourceLocation& where, fem::Structure& structure)
      : mesh_(mesh), numbers_(numbers), where_(where), out_(structure) {}

  std::vector<std::string> run() {
    for (const fem::ImportedRigidLink& link : mesh_.rigid_links) add(link);
    for (const fem::ImportedAverage& average : mesh_.averages) add(average);
    for (const fem::ImportedEquation& equation : mesh_.equations) add(equation);
    for (const fem::ImportedMass& mass : mesh_.masses) add(mass);
    for (const fem::ImportedSpring& spring : mesh_.springs) add(spring);
    return add_node_springs(springs_, mesh_.file, out_);
  }

 private:
  int node(int imported) const { return numbers_.at(static_cast<std::size_t>(imported)); }
  std::vector<int> nodes(const std::vector<int>& imported) const {
    std::vector<int> out;
    for (const int k : imported) out.push_back(node(k));
    return out;
  }
  std::string label(const char* what, const std::string& name, int line) const {
    std::string out = std::filesystem::path(mesh_.file).filename().string();
    if (line > 0) out += fmt::format(":{}", line);
    out += fmt::format(": {}", what);
    if (!name.empty()) out += fmt::format(" \"{}\"", name);
    return out;
  }

  void add(const fem::ImportedRigidLink& link) {
    out_.links.rigid.push_back({label("rigid link", link.name, link.line), node(link.reference),
                                nodes(link.nodes), link.variables});
  }
  void add(const fem::ImportedAverage& average) {
    const std::string name = label("average", average.name, average.line);
    std::vector<double> weights = average.weights;
    if (weights.empty()) weights.assign(average.nodes.size(), 1.0);
    const bool is_sound = weights.size() == average.nodes.size() && !weights.empty() &&
                          *std::min_element(weights.begin(), weights.end()) > 0.0;
    if (!is_sound) {
      throw InputError(where_,
                       fmt::format("{}: it needs nodes, and a positive weight for each", name));
    }
    out_.links.averages.push_back({name, node(average.reference), nodes(average.nodes),
                                   std::move(weights), average.variables, average.components});
  }
  void add(const fem::ImportedEquation& equation) {
    fem::LinearEquation& own = out_.links.equations.emplace_back();
    own.label = label("equation", "", equation.line);
    for (const auto& term : equation.terms) {
      own.terms.push_back({node(term.node), term.variable, term.coefficient});
    }
  }
  void add(const fem::ImportedSpring& spring) {
    if (spring.nodes[0] < 0 || spring.nodes[1] < 0) {
      throw InputError(where_, fmt::format("{}: a spring has only one end and would tie the body "
                                           "to ground; remove it and attach it as a load",
                                           mesh_.file));
    }
    springs_.push_back({node(spring.nodes[0]), node(spring.nodes[1]), spring.stiffness});
  }
  void add(const fem::ImportedMass& mass) {
    int at = node(mass.node);
    if (!mass.offset.isZero(0.0)) {
      const auto id = mesh_.node_ids[static_cast<std::size_t>(mass.node)];
      out_.nodes.push_back(
          {"", mesh_.positions[static_cast<std::size_t>(mass.node)] + mass.offset});
      const int own = static_cast<int>(out_.nodes.size()) - 1;
      out_.links.rigid.push_back(
          {label("offset of the point mass at node", std::to_string(id), 0), at, {own}});
      at = own;
    }
    out_.masses.add(at, mass.mass, mass.inertia);
  }

  const fem::ImportedMesh& mesh_;
  const std::vector<int>& numbers_;
  const SourceLocation& where_;
  fem::Structure& out_;
  std::vector<NodeSpring> springs_;
};

}  // namespace

void mark_linked_nodes(const fem::ImportedMesh& mesh, std::vector<bool>& used) {
  const auto use = [&used](int node) {
    if (node >= 0) used.at(static_cast<std::size_t>(node)) = true;
  };
  const auto use_all = [&](const auto& links) {
    for (const auto& link : links) {
      use(link.reference);
      std::for_each(link.nodes.begin(), link.nodes.end(), use);
    }
  };
  use_all(mesh.rigid_links);
  use_all(mesh.averages);
  for (const auto& equation : mesh.equations) {
    for (const auto& term : equation.terms) use(term.node);
  }
  for (const auto& spring : mesh.springs) {
    use(spring.nodes[0]);
    use(spring.nodes[1]);
  }
  for (const auto& mass : mesh.masses) use(mass.node);
}

void mark_given_nodes(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given,
                      std::vector<bool>& used) {
  std::vector<std::string> names;
  const auto add = [&names](const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  for (const fem::PointMassSpec& mass : given.masses) names.push_back(mass.at);
  if (given.links) {
    const auto add_links = [&](const auto& links) {
      for (const auto& link : links) {
        names.push_back(link.reference);
        add(link.nodes);
      }
    };
    add_links(given.links->rigid);
    add_links(given.links->averages);
    for (const auto& equation : given.links->equations) {
      for (const auto& term : equation.terms) names.push_back(term.node);
    }
    for (const auto& spring : given.links->springs) {
      names.insert(names.end(), spring.between.begin(), spring.between.end());
    }
  }
  if (names.empty()) return;
  std::unordered_map<std::int64_t, std::size_t> places;
  for (std::size_t k = 0; k < mesh.node_ids.size(); ++k) places.emplace(mesh.node_ids[k], k);
  for (const std::string& name : names) {
    const auto number = fem::node_number(name);
    const auto found = number ? places.find(*number) : places.end();
    if (found != places.end()) used[found->second] = true;
  }
}

std::vector<std::string> add_imported_links(const fem::ImportedMesh& mesh,
                                            const std::vector<int>& numbers,
                                            const SourceLocation& where,
                                            fem::Structure& structure) {
  return LinkImport(mesh, numbers, where, structure).run();
}

}  // namespace buckens::model
