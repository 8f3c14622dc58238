// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/links_from_spec.h"

#include <fmt/format.h>

namespace buckens::model {

namespace {

std::string label(const char* what, const SourceLocation& where) {
  return where.line > 0 ? fmt::format("{} of line {}", what, where.line) : std::string(what);
}

/// No variables stand for all.
std::array<bool, 6> chosen_variables(const std::vector<fem::NodeVariable>& variables) {
  std::array<bool, 6> out;
  out.fill(variables.empty());
  for (const fem::NodeVariable variable : variables) out[static_cast<std::size_t>(variable)] = true;
  return out;
}

}  // namespace

void add_links(const fem::StructureLinksSpec& spec, const NodeFinder& node,
               fem::Structure& structure) {
  const auto all = [&node](const std::vector<std::string>& names, const SourceLocation& where) {
    std::vector<int> out;
    for (const std::string& name : names) out.push_back(node(name, where));
    return out;
  };
  for (const fem::RigidLinkSpec& link : spec.rigid) {
    fem::RigidLink& own = structure.links.rigid.emplace_back();
    own.label = label("the rigid link", link.where);
    own.reference = node(link.reference, link.where);
    own.nodes = all(link.nodes, link.where);
    own.variables = chosen_variables(link.variables);
  }
  for (const fem::AverageLinkSpec& link : spec.averages) {
    std::vector<double> weights = link.weights;
    if (weights.empty()) weights.assign(link.nodes.size(), 1.0);
    structure.links.averages.push_back({label("the average", link.where),
                                        node(link.reference, link.where),
                                        all(link.nodes, link.where),
                                        std::move(weights),
                                        chosen_variables(link.variables),
                                        {}});
  }
  for (const fem::EquationSpec& equation : spec.equations) {
    fem::LinearEquation& own = structure.links.equations.emplace_back();
    own.label = label("the equation", equation.where);
    for (const fem::EquationTermSpec& term : equation.terms) {
      own.terms.push_back(
          {node(term.node, term.where), static_cast<int>(term.variable), term.coefficient});
    }
  }
  for (const fem::NodeSpringSpec& spring : spec.springs) {
    fem::SpringBlock::Stiffness stiffness = fem::SpringBlock::Stiffness::Zero();
    stiffness.diagonal() << spring.translation, spring.rotation;
    structure.springs.add(node(spring.between[0], spring.where),
                          node(spring.between[1], spring.where), stiffness);
  }
}

}  // namespace buckens::model
