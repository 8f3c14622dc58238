// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/generate_mesh.h"

#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/fem/mesh/cylinder_mesh.h"
#include "buckens/fem/mesh/plate_mesh.h"

namespace buckens::fem {

namespace {

/// A nodal matrix is built from the entries of element matrices, which are counted by int.
constexpr double kMostEntries = std::numeric_limits<int>::max();

Box box_of(const BoxMeshSpec& spec) { return {spec.from, spec.size, spec.divisions}; }

CellMesh cells_of(const BoxMeshSpec& spec) { return box_cells(box_of(spec)); }
template <class Round>
CellMesh cells_of(const Round& spec) {
  return cylinder_cells(spec.shape());
}

std::vector<std::string> names_of(const BoxMeshSpec& spec) {
  const auto [nx, ny, nz] = spec.divisions;
  std::vector<std::string> out;
  for (const NamedGridPlace& place :
       named_places({spec.from, spec.size, {2 * nx, 2 * ny, 2 * nz}})) {
    if (is_node(spec.element, place.place)) out.push_back(place.name);
  }
  return out;
}

std::vector<std::string> names_of(const MeshFileSpec& /*spec*/) { return {}; }
std::vector<std::string> names_of(const PlateMeshSpec& spec) {
  return plate_node_names(spec.divisions);
}

template <class Round>
std::vector<std::string> names_of(const Round& spec) {
  if (spec.shape().inner_radius > 0.0) return {};
  const int middle = spec.divisions[1] / 4;
  std::vector<std::string> out;
  if (is_node(spec.element, {middle, middle, 0})) out = {"bottom_centre", "top_centre"};
  if (is_node(spec.element, {middle, middle, spec.divisions[2]})) out.emplace_back("centre");
  return out;
}

double num_cells(const std::array<int, 3>& divisions) {
  return static_cast<double>(divisions[0]) * divisions[1] * divisions[2];
}

double cells_in(const BoxMeshSpec& spec) { return num_cells(spec.divisions); }
template <class Round>
double cells_in(const Round& spec) {
  const int quarter = spec.divisions[1] / 4;
  const double across = quarter;  // of the square core
  const bool bore = spec.shape().inner_radius > 0.0;
  return num_cells(spec.divisions) + (bore ? 0.0 : across * across * spec.divisions[2]);
}

}  // namespace

std::vector<std::string> named_nodes(const MeshSpec& spec) {
  return std::visit([](const auto& shape) { return names_of(shape); }, spec.shape);
}

std::optional<std::string> size_problem(const MeshSpec& spec) {
  if (spec.is_file()) return std::nullopt;
  const auto [count, most] = std::visit(
      []<class Shape>(const Shape& shape) {
        const auto limit = [](double variables) { return kMostEntries / (variables * variables); };
        if constexpr (std::is_same_v<Shape, MeshFileSpec>) {
          return std::pair(0.0, 0.0);
        } else if constexpr (std::is_same_v<Shape, PlateMeshSpec>) {
          const double fields = static_cast<double>(shape.divisions[0]) * shape.divisions[1];
          const bool is_quad = shape.element == ShellShapeKind::quad4;
          return std::pair(is_quad ? fields : 2.0 * fields, limit(is_quad ? 24.0 : 18.0));
        } else {
          return std::pair(cells_in(shape) * elements_per_cell(shape.element),
                           limit(3.0 * solid_topology(shape.element).num_nodes));
        }
      },
      spec.shape);
  if (count <= most) return std::nullopt;
  return fmt::format(
      "these are {:.3g} elements, more than the {:.3g} that can be numbered; use "
      "fewer",
      count, most);
}

GeneratedMesh add_mesh(Structure& structure, const MeshSpec& spec, const Material& material) {
  return std::visit(
      [&]<class Shape>(const Shape& shape) -> GeneratedMesh {
        if constexpr (std::is_same_v<Shape, MeshFileSpec> || std::is_same_v<Shape, PlateMeshSpec>) {
          throw ModelError("only solids are generated in this way");
        } else {
          return add_cells(structure, cells_of(shape), shape.form(), material);
        }
      },
      spec.shape);
}

}  // namespace buckens::fem
