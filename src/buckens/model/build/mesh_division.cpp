// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/mesh_division.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model {

namespace {

constexpr double kGigabyte = 1e9;

int num_cut_nodes(const MeshDivision& division) {
  int count = 0;
  for (const auto& copies : division.nodes) count += copies.size() > 1 ? 1 : 0;
  return count;
}

/// Gives an interface to the first part that has all its nodes.
void add_interface(const InterfaceRegion& interface,
                   const std::vector<std::vector<fem::PartPlace>>& copies, MeshDivision& out) {
  for (std::size_t p = 0; p < out.parts.size(); ++p) {
    std::vector<int> nodes;
    for (const int node : interface.region.nodes) {
      for (const fem::PartPlace& copy : copies[static_cast<std::size_t>(node)]) {
        if (copy.part == static_cast<int>(p)) nodes.push_back(copy.index);
      }
    }
    if (nodes.size() < interface.region.nodes.size()) continue;
    InterfaceRegion& own = out.parts[p].interfaces.emplace_back(interface);
    own.region = fem::renumbered(interface.region, nodes);
    return;
  }
  throw ModelError(fmt::format(
      "the nodes of interface \"{}\" lie in several of its {} frames, and a frame cannot rest on "
      "two of them; use fewer frames or a smaller region",
      interface.name, out.parts.size()));
}

}  // namespace

double predicted_bytes(const MeshDivision& division) {
  std::vector<double> cut(division.parts.size(), 0.0);
  for (const auto& copies : division.nodes) {
    for (const fem::PartPlace& copy : copies) {
      if (copies.size() > 1) cut[static_cast<std::size_t>(copy.part)] += 1.0;
    }
  }
  double bytes = 0.0;
  for (std::size_t p = 0; p < cut.size(); ++p) {
    const fem::Structure& part = division.parts[p].structure;
    const bool turns = part.beams.num_elements() > 0 || part.shells.num_elements() > 0;
    const double per_node = turns ? 6.0 : 3.0;
    const double n = per_node * static_cast<double>(part.nodes.size());
    const double m = per_node * cut[p];
    bytes += sizeof(double) * (4.0 * n * m + 8.0 * m * m);
  }
  return bytes;
}

void require_memory(const MeshDivision& division, double memory) {
  const double bytes = predicted_bytes(division);
  if (bytes <= memory) return;
  throw ModelError(fmt::format(
      "{} frames cut the mesh at {} nodes, whose interfaces would take about {:.3g} GB while "
      "stepping, more than the {:.3g} GB that may be used; use fewer frames",
      division.parts.size(), num_cut_nodes(division), bytes / kGigabyte, memory / kGigabyte));
}

MeshDivision divide_mesh(const NamedStructure& whole, const body::FrameDivision& frames) {
  const fem::Structure& structure = whole.structure;
  if (!structure.links.empty() || structure.springs.num_elements() > 0) {
    throw ModelError(
        "links and springs between the nodes of a body need one frame; remove `frames`, or make "
        "separate bodies with joints");
  }
  const int count = frames.of(fem::num_holding_elements(structure));
  fem::StructureParts divided = fem::divide(structure, fem::choose_parts(structure, count));
  MeshDivision out;
  for (fem::Structure& part : divided.parts) {
    out.parts.emplace_back();
    out.parts.back().structure = std::move(part);
  }
  for (std::size_t k = 0; k < whole.places.size(); ++k) {
    const MeshPlace& place = whole.places[k];
    const auto add = [&](const fem::PartPlace& at, bool is_node) {
      NamedStructure& part = out.parts[static_cast<std::size_t>(at.part)];
      part.names.push_back(whole.names[k]);
      part.places.push_back(is_node ? MeshPlace{at.index, -1, 0}
                                    : MeshPlace{-1, at.index, place.xi});
    };
    if (place.node >= 0) {
      for (const auto& copy : divided.nodes[static_cast<std::size_t>(place.node)]) add(copy, true);
    } else {
      add(divided.lines[static_cast<std::size_t>(place.element)], false);
    }
  }
  for (const auto& [number, node] : whole.numbers) {
    for (const fem::PartPlace& copy : divided.nodes[static_cast<std::size_t>(node)]) {
      out.parts[static_cast<std::size_t>(copy.part)].numbers.emplace(number, copy.index);
    }
  }
  for (const InterfaceRegion& interface : whole.interfaces) {
    add_interface(interface, divided.nodes, out);
  }
  out.nodes = std::move(divided.nodes);
  out.lines = std::move(divided.lines);
  out.solids = std::move(divided.solids);
  out.straight_nodes = structure.straight_nodes;
  return out;
}

}  // namespace buckens::model
