// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

constexpr std::int64_t kMostGenerated = 100'000'000;

/// Data lines may stand in a file of their own.
void enter_file(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string name = in.optional_parameter(keyword, "INPUT");
  if (!name.empty()) in.lines.include(name, keyword.place);
}

/// From cylindrical (r, angle in degrees, z) or spherical (r, longitude, latitude) coordinates.
Vector3d rectangular(const std::string& system, const Vector3d& given) {
  if (system.empty() || system == "R") return given;
  const double theta = given[1] * std::numbers::pi / 180.0;
  if (system == "C") {
    return {given[0] * std::cos(theta), given[0] * std::sin(theta), given[2]};
  }
  const double latitude = given[2] * std::numbers::pi / 180.0;
  return {given[0] * std::cos(latitude) * std::cos(theta),
          given[0] * std::cos(latitude) * std::sin(theta), given[0] * std::sin(latitude)};
}

/// Cells of an element over as many lines as it needs: a line that ends with a comma goes on,
/// unless all nodes are there.
bool element_cells(AbaqusReading& in, const AbaqusElementType& type,
                   std::vector<std::string_view>& cells, DeckPlace& place) {
  DeckRow row;
  cells.clear();
  if (!in.lines.next_row(row)) return false;
  place = row.place;
  const auto needed = static_cast<std::size_t>(type.num_nodes + 1);
  for (;;) {
    cells.insert(cells.end(), row.cells.begin(), row.cells.end());
    // Of any number of nodes only full lines go on: many decks have a comma behind each line.
    const bool goes_on =
        row.continues && (type.num_nodes >= 0 ? cells.size() < needed : row.cells.size() > 9);
    if (!goes_on) return true;
    if (in.lines.next_row(row)) continue;
    if (type.num_nodes < 0) return true;
    in.lines.fail(place, fmt::format("the element continues after the comma, but the data end "
                                     "here; {} of its {} nodes are there",
                                     cells.size() - 1, type.num_nodes));
  }
}

void check_count(AbaqusReading& in, const AbaqusElementType& type, std::size_t given,
                 DeckPlace place) {
  const auto needed = static_cast<std::size_t>(type.num_nodes);
  const bool has_direction = type.role == AbaqusRole::beam && given == needed + 1;
  if (given == needed || has_direction) return;
  if (given > needed && type.role != AbaqusRole::beam) {
    in.note(place, fmt::format("an element of type {} has {} nodes; any further ones on its line "
                               "are left out, as in CalculiX",
                               type.name, needed));
    return;
  }
  const bool is_straight = type.kind == fem::CellKind::line3 && given == 2;
  in.lines.fail(
      place, fmt::format("an element of type {} has {} nodes, found {}{}", type.name, needed, given,
                         is_straight ? "; a beam between two nodes is a B31, a bar a T3D2: "
                                       "write that as TYPE="
                                     : ""));
}

/// Elements that the model file wants left out keep their numbers, for the sets.
const AbaqusElementType* skipped_type(AbaqusReading& in, const std::string& name) {
  for (const AbaqusSkippedType& known : in.deck.skipped) {
    if (known.name == name) return &known.type;
  }
  AbaqusSkippedType& own = in.deck.skipped.emplace_back();
  own.name = name;
  own.type = {own.name, AbaqusRole::left_out, fem::CellKind::point1, -1, ""};
  return &own.type;
}

const char* why_unusable(const std::string& name) {
  if (name.starts_with("CAX") || name.starts_with("MAX") || name.starts_with("SAX")) {
    return "are axisymmetric and cannot be part of a three-dimensional body";
  }
  if (name.starts_with("M3D")) return "are membranes, which are not supported";
  if (name.starts_with("COH") || name.starts_with("GK")) {
    return "are cohesive or gasket elements, which are not supported";
  }
  if (name.starts_with("U")) return "are user elements, which the deck does not fully define";
  return "cannot be used";
}

/// Adds the data lines of *NSET or *ELSET.
void read_set_rows(AbaqusReading& in, const DeckKeyword& keyword, const char* what,
                   AbaqusSetPart& part) {
  DeckRow row;
  const bool is_generated = keyword.has("GENERATE");
  while (in.lines.next_row(row)) {
    if (is_generated) {
      AbaqusSetPart::Range& range = part.ranges.emplace_back();
      range.first = in.lines.label(row.cell(0), row.place, what);
      range.last = in.lines.label(row.cell(1), row.place, what);
      if (!row.cell(2).empty()) range.step = in.lines.label(row.cell(2), row.place, "the step");
      if (range.last < range.first) {
        in.lines.fail(row.place, fmt::format("the last number, {}, precedes the first, {}",
                                             range.last, range.first));
      }
      if ((range.last - range.first) / range.step + 1 > kMostGenerated) {
        in.lines.fail(row.place,
                      fmt::format("{} numbers would be generated, more than the {} that "
                                  "a mesh can have; is a digit too many here?",
                                  (range.last - range.first) / range.step + 1, kMostGenerated));
      }
      continue;
    }
    for (const std::string_view cell : row.cells) {
      if (cell.empty()) continue;
      if (files::deck_integer(cell)) {
        part.ids.push_back(in.lines.label(cell, row.place, what));
      } else {
        part.names.emplace_back(cell);
      }
    }
  }
}

}  // namespace

AbaqusSet& set_called(std::map<std::string, AbaqusSet>& sets, const std::string& name) {
  AbaqusSet& set = sets[upper(name)];
  if (set.name.empty()) set.name = name;
  return set;
}

Vector3d read_vector(const AbaqusLines& lines, const DeckRow& row, std::size_t first,
                     const char* what) {
  Vector3d out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[static_cast<Eigen::Index>(k)] = lines.number_or(row, first + k, 0.0, what);
  }
  return out;
}

void read_nodes(AbaqusReading& in, const DeckKeyword& keyword) {
  enter_file(in, keyword);
  const std::string system = upper(in.optional_parameter(keyword, "SYSTEM"));
  if (!system.empty() && system != "R" && system != "C" && system != "S") {
    in.lines.fail(keyword.place,
                  fmt::format("*NODE: SYSTEM={} is unknown; it is R, C or S", system));
  }
  AbaqusNodes& nodes = in.scope->nodes;
  AbaqusSetPart* part = nullptr;
  if (const std::string name = in.optional_parameter(keyword, "NSET"); !name.empty()) {
    part = &set_called(in.scope->node_sets, name).parts.emplace_back();
    part->place = keyword.place;
  }
  DeckRow row;
  while (in.lines.next_row(row)) {
    const std::int64_t id = in.lines.label(row.cell(0), row.place, "number of the node");
    const Vector3d given = read_vector(in.lines, row, 1, "coordinate");
    if (!row.cell(4).empty() || !row.cell(5).empty() || !row.cell(6).empty()) {
      in.note(row.place,
              "*NODE: normals after the coordinates are left out; beams have the directions of "
              "their sections, shells the normals of their elements");
    }
    nodes.ids.push_back(id);
    nodes.positions.push_back(in.system_axes * rectangular(system, given) + in.system_origin);
    nodes.places.push_back(row.place);
    if (part != nullptr) part->ids.push_back(id);
  }
}

void read_elements(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string name = upper(in.parameter(keyword, "TYPE"));
  const AbaqusElementType* type =
      in.skip.has(name) ? skipped_type(in, name) : find_abaqus_element(name);
  if (type == nullptr) {
    in.lines.fail(
        keyword.place,
        fmt::format("elements of type {} {}; solids C3D4 … C3D20R, shells S3 … S8R, beams "
                    "B31 … B33, bars T3D2, MASS and ROTARYI can be used{}",
                    name.substr(0, 40), why_unusable(name), SkipList::remedy(name.substr(0, 40))));
  }
  enter_file(in, keyword);
  AbaqusElements& block = in.scope->elements.emplace_back();
  block.type = type;
  std::vector<std::string_view> cells;
  DeckPlace place;
  while (element_cells(in, *type, cells, place)) {
    const std::int64_t id = in.lines.label(cells[0], place, "number of the element");
    block.ids.push_back(id);
    block.places.push_back(place);
    if (type->num_nodes < 0) continue;
    check_count(in, *type, cells.size() - 1, place);
    const auto num_nodes = static_cast<std::size_t>(type->num_nodes);
    const std::size_t num_read = num_nodes + (type->role == AbaqusRole::beam ? 1 : 0);
    for (std::size_t k = 1; k < cells.size() && k <= num_read; ++k) {
      const std::int64_t node = in.lines.label(cells[k], place, "node of the element");
      const bool is_direction = k > num_nodes;
      (is_direction ? block.direction_nodes : block.nodes).push_back(node);
    }
    if (type->role == AbaqusRole::beam) block.direction_nodes.resize(block.ids.size(), -1);
  }
  in.skip.takes(name, keyword.place.file == 0 ? keyword.place.line : 0,
                static_cast<int>(block.ids.size()));
  const std::string set_name = in.optional_parameter(keyword, "ELSET");
  if (set_name.empty()) return;
  AbaqusSetPart& part = set_called(in.scope->element_sets, set_name).parts.emplace_back();
  part.ids = block.ids;
  part.place = keyword.place;
}

void read_node_set(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSet& set = set_called(in.scope->node_sets, in.parameter(keyword, "NSET"));
  set.is_internal = set.is_internal || keyword.has("INTERNAL");
  set.is_unsorted = set.is_unsorted || keyword.has("UNSORTED");
  enter_file(in, keyword);
  AbaqusSetPart& part = set.parts.emplace_back();
  part.place = keyword.place;
  part.instance = in.optional_parameter(keyword, "INSTANCE");
  part.of_elements = in.optional_parameter(keyword, "ELSET");
  read_set_rows(in, keyword, "number of a node", part);
}

void read_element_set(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSet& set = set_called(in.scope->element_sets, in.parameter(keyword, "ELSET"));
  set.is_internal = set.is_internal || keyword.has("INTERNAL");
  enter_file(in, keyword);
  AbaqusSetPart& part = set.parts.emplace_back();
  part.place = keyword.place;
  part.instance = in.optional_parameter(keyword, "INSTANCE");
  read_set_rows(in, keyword, "number of an element", part);
}

namespace {

/// A surface of the faces of others that stand above it.
void unite_surfaces(AbaqusReading& in, const DeckKeyword& keyword, const std::string& name) {
  DeckRow row;
  while (in.lines.next_row(row)) {
    for (const std::string_view cell : row.cells) {
      if (cell.empty()) continue;
      const auto found = in.scope->surfaces.find(upper(cell));
      if (found == in.scope->surfaces.end()) {
        in.lines.fail(row.place, fmt::format("there is no surface \"{}\" above this line",
                                             std::string(cell.substr(0, 80))));
      }
      const std::vector<AbaqusSurface::Item> items = found->second.items;
      AbaqusSurface& surface = in.scope->surfaces[upper(name)];
      surface.name = name;
      surface.place = keyword.place;
      if (surface.items.size() + items.size() > 10'000'000) {
        in.lines.fail(row.place, "the surface has more than 10000000 lines");
      }
      surface.items.insert(surface.items.end(), items.begin(), items.end());
    }
  }
}

}  // namespace

void read_surface(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string& name = in.parameter(keyword, "NAME");
  const std::string type = upper(in.optional_parameter(keyword, "TYPE"));
  if (upper(in.optional_parameter(keyword, "COMBINE")) == "UNION") {
    return unite_surfaces(in, keyword, name);
  }
  if (keyword.has("COMBINE") || (!type.empty() && type != "ELEMENT" && type != "NODE")) {
    in.note(keyword.place, fmt::format("*SURFACE, NAME={}: surfaces that are combined, cut or "
                                       "analytical are left out; list the faces of elements",
                                       name));
    return;
  }
  auto& surfaces = type == "NODE" ? in.scope->node_surfaces : in.scope->surfaces;
  AbaqusSurface& surface = surfaces[upper(name)];
  surface.name = name;
  surface.is_of_nodes = type == "NODE";
  surface.is_internal = keyword.has("INTERNAL");
  surface.place = keyword.place;
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusSurface::Item& item = surface.items.emplace_back();
    item.reference = row.cell(0);
    item.face = surface.is_of_nodes ? "" : upper(row.cell(1));
    item.instance = in.optional_parameter(keyword, "INSTANCE");
    item.place = row.place;
    if (item.reference.empty()) {
      in.lines.fail(row.place, "this line must begin with an element, a node or a set");
    }
    if (!surface.is_of_nodes) continue;
    item.area = in.lines.number_or(row, 1, 1.0, "area of the node");
    if (!(item.area > 0.0)) in.lines.fail(row.place, "the area of a node must be positive");
  }
}

}  // namespace buckens::mesh_io
