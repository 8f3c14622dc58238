// SPDX-License-Identifier: Apache-2.0
// Thicknesses and directions of AbaqusMesh that elements have of their own.
#include <utility>

#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/mesh_io/abaqus/full_section.h"
#include "buckens/mesh_io/abaqus/mesh.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;
using fem::PropertyKind;

namespace {

/// Ten digits, so that equal ones make one property whatever the order of the sum.
double rounded(double value) { return *files::deck_number(fmt::format("{:.10g}", value)); }

}  // namespace

std::vector<double> AbaqusMesh::OwnValues::key() const {
  std::vector<double> out = {thickness, second};
  if (axes) out.insert(out.end(), axes->data(), axes->data() + axes->size());
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
  const AbaqusOrientation* axes = orientation_called(scope, section.orientation, section.place);
  if (axes == nullptr || axes->distribution.empty() || has_no_directions(section)) return out;
  const auto& points = distributed(scope, axes->distribution, element, 6, axes->place);
  out.axes = axes_from(Vector3d::Map(points.data()), Vector3d::Map(points.data() + 3));
  if (out.axes) return out;
  lines_.fail(axes->place,
              fmt::format("the points a and b of an element by distribution \"{}\" lie on one line "
                          "with the origin and give no axes",
                          axes->distribution));
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
