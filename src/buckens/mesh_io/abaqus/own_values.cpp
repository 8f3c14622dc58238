// SPDX-License-Identifier: Apache-2.0
// Thicknesses and directions of AbaqusMesh that elements have of their own.
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/mesh_io/abaqus/full_section.h"
#include "buckens/mesh_io/abaqus/mesh.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fem::PropertyKind;

namespace {

constexpr double kSameDirection = 1e-9;  // radians: rounding of coordinates

/// Ten digits, so that equal ones make one property whatever the order of the sum.
double rounded(double value) { return *files::deck_number(fmt::format("{:.10g}", value)); }

}  // namespace

std::vector<double> AbaqusMesh::OwnValues::key() const {
  std::vector<double> out = {thickness, second};
  if (axes) out.insert(out.end(), axes->data(), axes->data() + axes->size());
  out.insert(out.end(), angles.begin(), angles.end());
  return out;
}

bool AbaqusMesh::has_no_directions(const AbaqusSection& section) const {
  const auto material = deck_.materials.find(upper(section.material));
  return material != deck_.materials.end() && !material->second.orthotropic &&
         section.layers.empty();
}

AbaqusMesh::OwnValues AbaqusMesh::own_values(int scope, const AbaqusSection& section, int element) {
  OwnValues out;
  if (section.has_nodal_thickness) set_mean_measures(scope, section, element, out);
  if (!section.thicknesses.empty()) {
    out.thickness = distributed(scope, section.thicknesses, element, 1, section.place).front();
    if (!(out.thickness > 0.0)) {
      lines_.fail(section.place, fmt::format("the thickness {:g} by distribution \"{}\" must be "
                                             "positive",
                                             out.thickness, section.thicknesses));
    }
  }
  if (has_no_directions(section)) return out;
  const AbaqusOrientation* axes = reference_orientation(scope, section);
  if (axes != nullptr && !axes->distribution.empty()) {
    const auto& points = distributed(scope, axes->distribution, element, 6, axes->place);
    out.axes = axes_from(Vector3d::Map(points.data()), Vector3d::Map(points.data() + 3));
    if (!out.axes) {
      lines_.fail(axes->place,
                  fmt::format("the points a and b of an element by distribution \"{}\" lie on one "
                              "line with the origin and do not define axes",
                              axes->distribution));
    }
  }
  const bool has_axes = axes != nullptr && (axes->system == "RECTANGULAR" || out.axes);
  if (section.kind != PropertyKind::shell) return out;
  const Vector3d normal = shell_normal(scope, element);
  if (has_axes) check_normal(scope, *axes, out, normal);
  // Other systems are refused with the section.
  if (has_directed_layers(section) && (axes == nullptr || has_axes))
    set_layer_angles(scope, section, axes, normal, out);
  return out;
}

bool AbaqusMesh::has_directed_layers(const AbaqusSection& section) {
  return std::any_of(section.layers.begin(), section.layers.end(),
                     [](const auto& layer) { return !layer.orientation.empty(); });
}

/// From whose axes angles of layers are counted: the section's, else that of the first layer if
/// each layer has one. Null: the x axis of the deck.
const AbaqusOrientation* AbaqusMesh::reference_orientation(int scope,
                                                           const AbaqusSection& section) const {
  if (!section.orientation.empty()) {
    return orientation_called(scope, section.orientation, section.place);
  }
  const bool is_by_layers =
      !section.layers.empty() &&
      std::all_of(section.layers.begin(), section.layers.end(),
                  [](const auto& layer) { return !layer.orientation.empty(); });
  if (!is_by_layers) return nullptr;
  return orientation_called(scope, section.layers[0].orientation, section.layers[0].place);
}

Vector3d AbaqusMesh::shell_normal(int scope, int element) const {
  const auto [block, k] = names_.scopes()[static_cast<std::size_t>(scope)].at(element);
  const bool is_triangle =
      block->type->kind == fem::CellKind::tri3 || block->type->kind == fem::CellKind::tri6;
  const std::vector<int> nodes = names_.element_nodes({scope, element});
  const auto at = [&](std::size_t i) -> const Vector3d& {
    return names_.positions()[static_cast<std::size_t>(nodes[i])];
  };
  // Diagonals of four corners, sides of three.
  const Vector3d out = (at(2) - at(0)).cross(at(is_triangle ? 2 : 3) - at(1));
  const double length = out.norm();
  return length > 0.0 ? Vector3d(out / length) : out;  // elements without an area are refused later
}

Matrix3d AbaqusMesh::in_order_of_shell(const Matrix3d& axes, int normal) {
  Matrix3d out;
  for (int k = 0; k < 3; ++k) out.col(k) = axes.col((normal + 1 + k) % 3);
  return out;
}

/// Without a second line axis 3 must be the normal, as CalculiX has it.
void AbaqusMesh::check_normal(int scope, const AbaqusOrientation& axes, const OwnValues& own,
                              const Vector3d& normal) {
  constexpr double kAlong = 0.02;  // sine of the angle in between
  if (axes.normal) return;
  const Vector3d third = names_.scopes()[static_cast<std::size_t>(scope)].rotation *
                         own.axes.value_or(Matrix3d::Identity()) * axes.axes.col(2);
  if (third.cross(normal).norm() <= kAlong) return;
  lines_.fail(axes.place,
              fmt::format("orientation \"{}\" is used for shells, so its second line must say "
                          "which of its axes, 1, 2 or 3, is near their normal, and the angle "
                          "about it: \"3, 0.\" takes its axis 1 as direction 1",
                          axes.name));
}

/// From the section's direction 1 to those of the layers, both in the plane of the element.
void AbaqusMesh::set_layer_angles(int scope, const AbaqusSection& section,
                                  const AbaqusOrientation* reference, const Vector3d& normal,
                                  OwnValues& out) {
  constexpr double kNormal = 2e-3;  // sine, as that by which shells choose their axis
  const Matrix3d& rotation = names_.scopes()[static_cast<std::size_t>(scope)].rotation;
  const auto flat = [&](const Vector3d& v) -> Vector3d { return v - v.dot(normal) * normal; };
  const auto first_axis = [&](const AbaqusOrientation& axes, const OwnValues& own) -> Vector3d {
    check_normal(scope, axes, own, normal);
    return flat(in_order_of_shell(rotation * own.axes.value_or(Matrix3d::Identity()) * axes.axes,
                                  axes.normal.value_or(2))
                    .col(0));
  };
  Vector3d from = flat(Vector3d::UnitX());
  if (reference == nullptr && from.norm() < kNormal) from = flat(Vector3d::UnitZ());
  if (reference != nullptr) from = first_axis(*reference, out);
  for (const AbaqusSection::Layer& layer : section.layers) {
    double& angle = out.angles.emplace_back(0.0);
    if (layer.orientation.empty()) continue;
    const auto* axes = orientation_called(scope, layer.orientation, layer.place);
    if (axes == reference) continue;
    if (axes->system != "RECTANGULAR") {
      lines_.fail(layer.place,
                  fmt::format("the layer has the orientation \"{}\" of {}; give one of "
                              "SYSTEM=RECTANGULAR, or an angle in degrees",
                              layer.orientation, axes->system));
    }
    const Vector3d to = first_axis(*axes, {});
    if (!(to.norm() > kNormal)) {
      lines_.fail(layer.place,
                  fmt::format("direction 1 of orientation \"{}\" is along the normal of an element "
                              "of \"{}\"; name another axis as the one near its normal",
                              layer.orientation, section.element_set));
    }
    angle = rounded(std::atan2(normal.dot(from.cross(to)), from.dot(to)));
    if (std::abs(angle) < kSameDirection) angle = 0.0;
  }
}

/// Of the nodes of an element, by *NODAL THICKNESS; nodes without one have that of the section.
void AbaqusMesh::set_mean_measures(int scope, const AbaqusSection& section, int element,
                                   OwnValues& out) {
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  const auto [known, is_new] = thicknesses_.try_emplace(scope);
  if (is_new) {
    for (const AbaqusThickness& entry : placed.scope->thicknesses) {
      for (const int node : names_.nodes(scope, entry.reference, entry.place)) {
        known->second[node] = &entry;
      }
    }
  }
  const bool is_beam = section.kind == PropertyKind::beam;
  const double first = is_beam ? section.measures[0] : section.thickness.value_or(0.0);
  const std::vector<int> nodes = names_.element_nodes({scope, element});
  for (const int node : nodes) {
    const auto found = known->second.find(node);
    const bool has_own = found != known->second.end();
    if (!has_own && first == 0.0) {
      lines_.fail(section.place,
                  fmt::format("node {} has no *NODAL THICKNESS, and its section no thickness",
                              names_.labels()[static_cast<std::size_t>(node)]));
    }
    if (has_own && is_beam && !(found->second->second > 0.0)) {
      lines_.fail(found->second->place, "the second thickness of a beam must be positive");
    }
    out.thickness += has_own ? found->second->thickness : first;
    if (is_beam) out.second += has_own ? found->second->second : section.measures[1];
  }
  out.thickness = rounded(out.thickness / static_cast<double>(nodes.size()));
  out.second = rounded(out.second / static_cast<double>(nodes.size()));
}

const std::vector<double>& AbaqusMesh::distributed(int scope, const std::string& name, int element,
                                                   std::size_t count, DeckPlace place) {
  const AbaqusDistribution* found = nullptr;
  int owner = scope;
  for (const int of : {scope, 0}) {
    const auto& all = names_.scopes()[static_cast<std::size_t>(of)].scope->distributions;
    const auto entry = all.find(upper(name));
    if (entry == all.end()) continue;
    found = &entry->second;
    owner = of;
    break;
  }
  if (found == nullptr) {
    lines_.fail(place, fmt::format("there is no *DISTRIBUTION \"{}\"", name));
  }
  if (!found->is_of_elements) {
    lines_.fail(found->place, "only a *DISTRIBUTION with LOCATION=ELEMENT can be used here");
  }
  const auto [known, is_new] = distributions_.try_emplace({scope, upper(name)});
  if (is_new) {
    for (const auto& entry : found->entries) {
      for (const auto& at : names_.elements(owner, entry.reference, entry.place)) {
        if (at.scope == scope) known->second[at.element] = &entry.values;
      }
    }
  }
  const auto own = known->second.find(element);
  const std::vector<double>& out = own == known->second.end() ? found->otherwise : *own->second;
  if (out.size() >= count) return out;
  lines_.fail(found->place,
              fmt::format("distribution \"{}\" gives an element {} values; {} are needed, on the "
                          "line of the element or on the first one, for all others",
                          name, out.size(), count));
}

void AbaqusMesh::set_own_measures(const AbaqusSection& section, const OwnValues& own,
                                  fem::ImportedProperty& property) {
  if (own.thickness == 0.0) return;
  const bool is_beam = property.kind == PropertyKind::beam;
  if (is_beam) {
    property.section = full_section(section.is_round, own.thickness, own.second);
    property.section->where = lines_.where(section.place);
  } else {
    property.thickness = own.thickness;
    property.offset = -section.offset * own.thickness;
  }
  if (!section.has_nodal_thickness || !thicknesses_noted_.insert(section.place.line).second) return;
  out_.notes.push_back(
      note_at(section.place,
              fmt::format("NODAL THICKNESS: each {} the mean thickness of its nodes",
                          is_beam ? "beam has" : "shell has"),
              1));
}

}  // namespace buckens::mesh_io
