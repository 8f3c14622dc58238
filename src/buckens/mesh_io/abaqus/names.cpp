// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/names.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/files/deck_number.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

template <class Named>
std::vector<std::string> names_in(const std::map<std::string, Named>& sets) {
  std::vector<std::string> out;
  for (const auto& [key, set] : sets) out.push_back(set.name);
  return out;
}

std::int64_t largest_of(const std::vector<std::int64_t>& labels, std::int64_t so_far) {
  for (const std::int64_t label : labels) so_far = std::max(so_far, label);
  return so_far;
}

}  // namespace

std::pair<const AbaqusElements*, std::size_t> AbaqusPlaced::at(int element) const {
  const auto next = std::upper_bound(first_of_block.begin(), first_of_block.end(), element);
  const auto block = static_cast<std::size_t>(next - first_of_block.begin()) - 1;
  return {&scope->elements[block], static_cast<std::size_t>(element - first_of_block[block])};
}

AbaqusNames::AbaqusNames(const AbaqusDeck& deck, const AbaqusLines& lines) : lines_(lines) {
  place_scope(deck.root, nullptr);
  for (const AbaqusInstance& instance : deck.instances) place_scope(instance.scope, &instance);
}

void AbaqusNames::place_scope(const AbaqusScope& scope, const AbaqusInstance* instance) {
  AbaqusPlaced placed;
  placed.scope = &scope;
  placed.first_node = static_cast<int>(positions_.size());
  if (instance != nullptr) {
    placed.instance = instance->name;
    placed.rotation = instance->rotation;
    placed.origin =
        instance->rotation * (instance->translation - instance->centre) + instance->centre;
  }
  const AbaqusNodes& nodes = scope.nodes;
  placed.nodes = LabelIndex(nodes.ids.size(), largest_of(nodes.ids, 0));
  for (std::size_t k = 0; k < nodes.ids.size(); ++k) {
    const auto next = static_cast<int>(positions_.size());
    const Vector3d position = placed.rotation * nodes.positions[k] + placed.origin;
    const int before = placed.nodes.add(nodes.ids[k], next);
    if (before < 0) {
      positions_.push_back(position);
      labels_.push_back(nodes.ids[k]);
    } else if (positions_[static_cast<std::size_t>(before)] != position) {
      lines_.fail(nodes.places[k],
                  fmt::format("node {} is defined a second time, at another place{}; give it "
                              "another number",
                              nodes.ids[k], described(static_cast<int>(scopes_.size()))));
    }
  }
  placed.num_nodes = static_cast<int>(positions_.size()) - placed.first_node;
  number_elements(placed);
  if (instance != nullptr) instances_[upper(instance->name)] = static_cast<int>(scopes_.size());
  scopes_.push_back(std::move(placed));
}

void AbaqusNames::number_elements(AbaqusPlaced& placed) {
  std::size_t count = 0;
  std::int64_t largest = 0;
  for (const AbaqusElements& block : placed.scope->elements) {
    count += block.ids.size();
    largest = largest_of(block.ids, largest);
  }
  placed.elements = LabelIndex(count, largest);
  for (const AbaqusElements& block : placed.scope->elements) {
    placed.first_of_block.push_back(placed.num_elements);
    for (std::size_t k = 0; k < block.ids.size(); ++k) {
      if (placed.elements.add(block.ids[k], placed.num_elements++) >= 0) {
        lines_.fail(block.places[k], fmt::format("element {} is defined a second time; give it "
                                                 "another number",
                                                 block.ids[k]));
      }
      const auto stride = static_cast<std::size_t>(std::max(0, block.type->num_nodes));
      for (std::size_t i = k * stride; i < (k + 1) * stride; ++i) {
        if (placed.nodes.find(block.nodes[i]) >= 0) continue;
        lines_.fail(
            block.places[k],
            fmt::format("element {} refers to node {}, which is not defined{}", block.ids[k],
                        block.nodes[i], placed.instance.empty() ? "" : " in this part"));
      }
    }
  }
}

std::string AbaqusNames::described(int scope) const {
  if (scope >= static_cast<int>(scopes_.size())) return "";
  const std::string& instance = scopes_[static_cast<std::size_t>(scope)].instance;
  return instance.empty() ? "" : fmt::format(" of instance \"{}\"", instance);
}

int AbaqusNames::find_instance(const std::string& name) const {
  const auto found = instances_.find(upper(name));
  return found == instances_.end() ? -1 : found->second;
}

AbaqusNames::Scoped AbaqusNames::in_instance(int scope, const std::string& reference,
                                             const std::string& instance, DeckPlace place) const {
  if (!instance.empty()) {
    const int found = find_instance(instance);
    if (found >= 0) return {found, reference};
    // Decks that were flattened keep the parameter.
    if (instances_.empty()) return {scope, reference};
    lines_.fail(place, fmt::format("there is no instance \"{}\"", instance));
  }
  for (std::size_t dot = reference.find('.'); scope == 0 && dot != std::string::npos;
       dot = reference.find('.', dot + 1)) {
    const int found = find_instance(reference.substr(0, dot));
    if (found >= 0) return {found, reference.substr(dot + 1)};
  }
  return {scope, reference};
}

std::vector<int> AbaqusNames::nodes(int scope, const std::string& reference, DeckPlace place) {
  const Scoped scoped = in_instance(scope, reference, "", place);
  const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(scoped.scope)];
  if (files::deck_integer(scoped.name)) {
    const int node = placed.nodes.find(lines_.label(scoped.name, place, "number of a node"));
    if (node >= 0) return {node};
    lines_.fail(place, fmt::format("there is no node {}{}", scoped.name, described(scoped.scope)));
  }
  const auto found = placed.scope->node_sets.find(upper(scoped.name));
  if (found != placed.scope->node_sets.end()) return nodes(scoped.scope, found->second);
  lines_.fail(place,
              fmt::format("there is no node set \"{}\"{}.{}", scoped.name, described(scoped.scope),
                          base::suggestion(scoped.name, names_in(placed.scope->node_sets))));
}

std::vector<int> AbaqusNames::nodes_of_set(int scope, const std::string& name, DeckPlace place) {
  const Scoped scoped = in_instance(scope, name, "", place);
  const auto& sets = scopes_[static_cast<std::size_t>(scoped.scope)].scope->node_sets;
  const auto found = sets.find(upper(scoped.name));
  return found != sets.end() ? nodes(scoped.scope, found->second) : nodes(scope, name, place);
}

std::vector<AbaqusElementAt> AbaqusNames::elements_of_set(int scope, const std::string& name,
                                                          DeckPlace place) {
  const Scoped scoped = in_instance(scope, name, "", place);
  const auto& sets = scopes_[static_cast<std::size_t>(scoped.scope)].scope->element_sets;
  const auto found = sets.find(upper(scoped.name));
  return found != sets.end() ? elements(scoped.scope, found->second) : elements(scope, name, place);
}

int AbaqusNames::node(int scope, const std::string& reference, DeckPlace place) {
  const auto found = nodes(scope, reference, place);
  if (found.size() == 1) return found.front();
  lines_.fail(place,
              fmt::format("\"{}\" has {} nodes; expected a single node", reference, found.size()));
}

std::vector<AbaqusElementAt> AbaqusNames::elements(int scope, const std::string& reference,
                                                   DeckPlace place) {
  const Scoped scoped = in_instance(scope, reference, "", place);
  const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(scoped.scope)];
  if (files::deck_integer(scoped.name)) {
    const int element =
        placed.elements.find(lines_.label(scoped.name, place, "number of an element"));
    if (element >= 0) return {{scoped.scope, element}};
    lines_.fail(place,
                fmt::format("there is no element {}{}", scoped.name, described(scoped.scope)));
  }
  const auto found = placed.scope->element_sets.find(upper(scoped.name));
  if (found != placed.scope->element_sets.end()) return elements(scoped.scope, found->second);
  lines_.fail(
      place,
      fmt::format("there is no element set \"{}\"{}.{}", scoped.name, described(scoped.scope),
                  base::suggestion(scoped.name, names_in(placed.scope->element_sets))));
}

std::vector<bool> AbaqusNames::turning_nodes() const {
  std::vector<bool> out(positions_.size(), false);
  for (std::size_t s = 0; s < scopes_.size(); ++s) {
    for (int e = 0; e < scopes_[s].num_elements; ++e) {
      const AbaqusRole role = scopes_[s].at(e).first->type->role;
      if (role != AbaqusRole::shell && role != AbaqusRole::beam) continue;
      for (const int node : element_nodes({static_cast<int>(s), e})) {
        out[static_cast<std::size_t>(node)] = true;
      }
    }
  }
  return out;
}

std::vector<int> AbaqusNames::element_nodes(const AbaqusElementAt& at) const {
  const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(at.scope)];
  const auto [block, k] = placed.at(at.element);
  std::vector<int> out;
  const auto stride = static_cast<std::size_t>(std::max(0, block->type->num_nodes));
  for (std::size_t i = k * stride; i < (k + 1) * stride; ++i) {
    out.push_back(placed.nodes.find(block->nodes[i]));
  }
  return out;
}

}  // namespace buckens::mesh_io
