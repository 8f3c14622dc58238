// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/find_section.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/solid/recovery.h"

namespace buckens::model {

namespace {

/// The numbered element, counted through lines, then solids.
void find_numbered(const SectionPlace& kind, const WholeBody& whole, const fem::FeModel& fe,
                   SensorPlace& found) {
  const std::size_t lines = whole.is_divided() ? whole.lines.size() : fem::line_elements(fe).size();
  const std::size_t solids =
      whole.is_divided() ? whole.solids.size() : static_cast<std::size_t>(fem::num_solids(fe));
  const auto number = static_cast<std::size_t>(*kind.element - 1);
  if (number >= lines + solids) {
    throw InputError(kind.of.where, fmt::format("body \"{}\" has {} elements, not {}", kind.of.body,
                                                lines + solids, *kind.element));
  }
  const bool is_line = number < lines;
  MeshCopy place{found.body, static_cast<int>(is_line ? number : number - lines)};
  if (whole.is_divided()) place = is_line ? whole.lines[number] : whole.solids[number - lines];
  found.body = place.body;
  if (is_line) {
    found.element = place.index;
  } else {
    found.solids = {place.index};
  }
}

void find_at(const MeshPlace& place, const fem::FeModel& fe, SensorPlace& found) {
  if (place.node < 0) {
    found.element = place.element;
    return;
  }
  const auto lines = fem::line_elements(fe);
  for (std::size_t e = 0; e < lines.size(); ++e) {
    if (lines[e].a != place.node && lines[e].b != place.node) continue;
    found.element = static_cast<int>(e);
    found.end = lines[e].a == place.node ? 0 : 1;
    return;
  }
  if (fem::num_solids(fe) == 0) return;
  found.solids = fem::solids_at_nodes(fe)[static_cast<std::size_t>(place.node)];
}

/// The solids that touch any of the nodes.
void find_around(const std::vector<int>& nodes, const fem::FeModel& fe, SensorPlace& found) {
  const auto solids = fem::solids_at_nodes(fe);
  for (const int node : nodes) {
    const auto& own = solids[static_cast<std::size_t>(node)];
    found.solids.insert(found.solids.end(), own.begin(), own.end());
  }
  std::sort(found.solids.begin(), found.solids.end());
  found.solids.erase(std::unique(found.solids.begin(), found.solids.end()), found.solids.end());
}

}  // namespace

void find_section(const SectionPlace& kind, bool of_forces, MarkerFinder& find,
                  SensorPlace& found) {
  found.body = find.marker(kind.of, false).body;
  const Model& model = find.model();
  const auto b = static_cast<std::size_t>(found.body);
  if (found.body == kGround || !model.bodies[b].flexible) {
    throw ModelError(kind.of.where,
                     fmt::format("\"{}\" is not on a flexible body; section forces and stresses "
                                 "exist on meshes only",
                                 kind.of.text));
  }
  const fem::FeModel& fe = model.bodies[b].flexible->mesh();
  if (fe.blocks.empty()) {
    throw ModelError(kind.of.where,
                     fmt::format("body \"{}\" is given by matrices; without elements "
                                 "it has neither stresses nor section forces",
                                 kind.of.body));
  }
  const WholeBody& whole = model.wholes[static_cast<std::size_t>(model.whole_of(found.body))];
  if (kind.element) {
    find_numbered(kind, whole, fe, found);
  } else if (const auto* interface = find.table(found.body).interface(kind.of.marker)) {
    find_around(interface->region.nodes, fe, found);
  } else if (!whole.is_divided() || !kind.of.marker.empty()) {
    const auto place = find.table(found.body).place(kind.of);
    if (place) find_at(*place, fe, found);
  }
  const bool is_solid = !found.solids.empty() || fem::line_elements(fe).empty();
  if (!of_forces || !is_solid) return;
  throw ModelError(kind.of.where, fmt::format("\"{}\" is not a section of a beam or bar; solids "
                                              "have no section forces, observe their `stress`",
                                              kind.of.text));
}

}  // namespace buckens::model
