// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/generate_mesh.h"

#include <limits>

#include <fmt/format.h>

#include "buckens/fem/box_mesh.h"

namespace buckens::fem {

namespace {

// Nodal variables and entries of element matrices are numbered by int.
constexpr double kMostElements = std::numeric_limits<int>::max() / 576.0;

Box box_of(const BoxMeshSpec& spec) { return {spec.from, spec.size, spec.divisions}; }

std::vector<NamedNode> nodes_of(const BoxMeshSpec& spec) {
  const Box box = box_of(spec);
  std::vector<NamedNode> out;
  for (const NamedGridPlace& place : named_places(box)) {
    out.push_back({place.name, box.node(place.place)});
  }
  return out;
}

double num_elements(const BoxMeshSpec& spec) {
  double count = 1.0;
  for (const int n : spec.divisions) count *= n;
  return count;
}

int add(Structure& structure, const BoxMeshSpec& spec, const Material& material) {
  return add_box(structure, box_of(spec), material, spec.form()).first_node;
}

}  // namespace

std::vector<NamedNode> named_nodes(const MeshSpec& spec) {
  return std::visit([](const auto& shape) { return nodes_of(shape); }, spec.shape);
}

std::optional<std::string> size_problem(const MeshSpec& spec) {
  const double count =
      std::visit([](const auto& shape) { return num_elements(shape); }, spec.shape);
  if (count <= kMostElements) return std::nullopt;
  return fmt::format(
      "these are {:.3g} elements, more than the {:.3g} that can be numbered; use "
      "fewer",
      count, kMostElements);
}

int add_mesh(Structure& structure, const MeshSpec& spec, const Material& material) {
  return std::visit([&](const auto& shape) { return add(structure, shape, material); }, spec.shape);
}

}  // namespace buckens::fem
