// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/elements.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/hinges.h"
#include "buckens/mesh_io/nastran/midside_nodes.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fem::CellKind;

namespace {

using Kind = NastranElementKind;

constexpr int kMissing = -2;  // a mid-side node that is left out

/// Where Nastran lists the nodes of a shape of fem::CellKind; empty where the order is the same.
std::span<const int> node_order(CellKind kind) {
  // Edges in Nastran: below, vertical, above; in fem::CellKind: below, above, vertical.
  static constexpr std::array<int, 15> kWedge = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
  static constexpr std::array<int, 20> kHex = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                               10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
  if (kind == CellKind::wedge15) return kWedge;
  if (kind == CellKind::hex20) return kHex;
  return {};
}

CellKind cell_kind(const NastranElement& element) {
  switch (element.kind) {
    case Kind::tetra:
      return element.num_nodes == 4 ? CellKind::tet4 : CellKind::tet10;
    case Kind::pyramid:
      return CellKind::pyramid5;
    case Kind::penta:
      return element.num_nodes == 6 ? CellKind::wedge6 : CellKind::wedge15;
    case Kind::hexa:
      return element.num_nodes == 8 ? CellKind::hex8 : CellKind::hex20;
    case Kind::tria3:
    case Kind::triar:
      return CellKind::tri3;
    case Kind::quad4:
    case Kind::quadr:
      return CellKind::quad4;
    case Kind::tria6:
      return CellKind::tri6;
    case Kind::quad8:
      return CellKind::quad8;
    default:
      return CellKind::line2;
  }
}

class ElementBuilder {
 public:
  ElementBuilder(const NastranBulk& bulk, NastranCoordinates& coordinates,
                 NastranProperties& properties, NastranNonstructuralMass& nonstructural,
                 NastranNotes& notes, fem::ImportedMesh& mesh)
      : bulk_(bulk),
        coordinates_(coordinates),
        properties_(properties),
        nonstructural_(nonstructural),
        notes_(notes),
        midsides_(coordinates, mesh),
        mesh_(mesh) {}

  void add(const NastranElement& element);

 private:
  fem::ImportedBlock& block_of(const NastranElement& element, CellKind kind, int property);
  void read_nodes(const NastranElement& element);
  void fill_midsides(const NastranElement& element);
  void straighten(const NastranElement& element);
  void add_line(const NastranElement& element);
  int shifted_end(int node, const Vector3d& shift, const NastranElement& element);
  void add_hinges(const NastranElement& element, const NastranLineDetails& line, int node_a);
  NastranLineDetails line_details(const NastranElement& element) const;
  Vector3d up_direction(const NastranElement& element, const NastranLineDetails& line, int node_a,
                        const Vector3d& along, double angle) const;
  void spread_mass(const NastranElement& element, int property);
  const Vector3d& position(int node) const {
    return coordinates_.positions()[static_cast<std::size_t>(node)];
  }
  [[noreturn]] static void fail(const NastranElement& element, const std::string& text) {
    throw InputError(element.place.where(),
                     fmt::format("{} {}: {}", name_of(element.kind), element.id, text));
  }

  const NastranBulk& bulk_;
  NastranCoordinates& coordinates_;
  NastranProperties& properties_;
  NastranNonstructuralMass& nonstructural_;
  NastranNotes& notes_;
  NastranMidsides midsides_;
  fem::ImportedMesh& mesh_;
  std::map<std::tuple<CellKind, Kind, int>, std::size_t> block_of_;
  std::map<std::tuple<int, std::array<double, 3>>, int> shifted_;
  std::vector<int> nodes_;  // of the element at hand
  std::vector<Vector3d> corners_;
};

fem::ImportedBlock& ElementBuilder::block_of(const NastranElement& element, CellKind kind,
                                             int property) {
  const auto [entry, is_new] =
      block_of_.try_emplace({kind, element.kind, property}, mesh_.blocks.size());
  if (is_new) {
    fem::ImportedBlock block;
    block.kind = kind;
    block.source = name_of(element.kind);
    block.property = property;
    mesh_.blocks.push_back(std::move(block));
  }
  return mesh_.blocks[entry->second];
}

void ElementBuilder::read_nodes(const NastranElement& element) {
  nodes_.clear();
  for (int i = 0; i < element.num_nodes; ++i) {
    const std::int64_t id = bulk_.element_nodes[element.first_node + static_cast<std::size_t>(i)];
    const int node = id == NastranBulk::kNoNode ? kMissing : coordinates_.find_node(id);
    if (node == -1) fail(element, fmt::format("there is no GRID {}", id));
    nodes_.push_back(node);
  }
  if (element.kind == Kind::pyramid) {
    straighten(element);
  } else if (std::find(nodes_.begin(), nodes_.end(), kMissing) != nodes_.end()) {
    fill_midsides(element);
  }
}

/// Pyramids have five nodes here: those in the middle of their edges follow the ends, so that
/// neighbours meet without a gap.
void ElementBuilder::straighten(const NastranElement& element) {
  const std::span<const NastranEdge> edges = nastran_edges(element.kind);
  const std::size_t corners = 5;
  for (std::size_t i = corners; i < nodes_.size(); ++i) {
    if (nodes_[i] == kMissing) continue;
    const auto a = static_cast<std::size_t>(edges[i - corners][0]);
    const auto b = static_cast<std::size_t>(edges[i - corners][1]);
    if (midsides_.straighten(nodes_[i], nodes_[a], nodes_[b], element.place.line)) continue;
    fail(element,
         "a mid-side node is off the middle of its edge; pyramids have straight edges here: "
         "straighten it, or mesh with CTETRA of ten nodes");
  }
  if (nodes_.size() == corners) return;
  nodes_.resize(corners);
  notes_.add("CPYRAM of 13 nodes: taken with 5; the nodes of its edges follow the corners",
             element.place);
}

/// Nodes in the place of mid-side nodes that are left out.
void ElementBuilder::fill_midsides(const NastranElement& element) {
  const std::span<const NastranEdge> edges = nastran_edges(element.kind);
  const std::size_t corners = nodes_.size() - edges.size();
  Vector3d normal = Vector3d::Zero();
  if (fem::dimension_of(cell_kind(element)) == 2) {
    const Vector3d a = position(nodes_[2]) - position(nodes_[0]);
    const Vector3d b = position(nodes_[corners - 1]) - position(nodes_[1]);
    normal = a.cross(b).normalized();
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (nodes_[corners + i] != kMissing) continue;
    const auto a = static_cast<std::size_t>(edges[i][0]), b = static_cast<std::size_t>(edges[i][1]);
    nodes_[corners + i] = midsides_.node(nodes_[a], nodes_[b], normal, element.place.line);
  }
  notes_.add(fmt::format("{}: edges without a mid-side node are straight and move linearly "
                         "between their ends",
                         name_of(element.kind)),
             element.place);
}

void ElementBuilder::add(const NastranElement& element) {
  read_nodes(element);
  const CellKind kind = cell_kind(element);
  if (kind == CellKind::line2 && element.details >= 0) {
    add_line(element);
    return;
  }
  corners_.clear();
  if (fem::dimension_of(kind) == 2) {
    const bool is_curved = kind == CellKind::tri6 || kind == CellKind::quad8;
    const std::size_t count = is_curved ? nodes_.size() / 2 : nodes_.size();
    for (std::size_t i = 0; i < count; ++i) corners_.push_back(position(nodes_[i]));
  }
  const int property = properties_.of(element, corners_);
  fem::ImportedBlock& block = block_of(element, kind, property);
  block.ids.push_back(element.id);
  const std::span<const int> order = node_order(kind);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    block.nodes.push_back(nodes_[order.empty() ? i : static_cast<std::size_t>(order[i])]);
  }
  spread_mass(element, property);
}

/// The end of a beam: the node itself, or a node beside it that follows it as a rigid body.
int ElementBuilder::shifted_end(int node, const Vector3d& shift, const NastranElement& element) {
  if (shift.isZero(0.0)) return node;
  const auto [entry, is_new] = shifted_.try_emplace({node, {shift.x(), shift.y(), shift.z()}}, 0);
  if (is_new) {
    const Vector3d place = position(node) + shift;
    entry->second = coordinates_.add_node(place);
    fem::ImportedRigidLink link;
    link.name = fmt::format("offset {}", coordinates_.node_ids().back());
    link.reference = node;
    link.nodes = {entry->second};
    link.line = element.place.line;
    mesh_.rigid_links.push_back(std::move(link));
    notes_.add(fmt::format("{}: offsets WA, WB become additional nodes on rigid links",
                           name_of(element.kind)),
               element.place);
  }
  return entry->second;
}

/// The section's z axis.
/// @param along from one end to the other
/// @param angle by which the section is turned from Nastran's axes
Vector3d ElementBuilder::up_direction(const NastranElement& element, const NastranLineDetails& line,
                                      int node_a, const Vector3d& along, double angle) const {
  Vector3d v(line.orientation[0], line.orientation[1], line.orientation[2]);
  if (line.orientation_node != 0) {
    const int node = coordinates_.find_node(line.orientation_node);
    if (node < 0) fail(element, fmt::format("there is no GRID {} (G0)", line.orientation_node));
    v = position(node) - position(node_a);
  } else if (!line.basic_orientation) {
    v = coordinates_.displacement_axes(node_a) * v;
  }
  const Vector3d x = along.normalized();
  const Vector3d z = x.cross(v);
  if (!(along.norm() > 0.0) || !(z.norm() > 1e-6 * v.norm())) {
    fail(element, "both ends coincide, or the orientation vector is parallel to the beam");
  }
  const Vector3d z_unit = z.normalized();
  return std::cos(angle) * z_unit - std::sin(angle) * z_unit.cross(x);
}

/// What the element says of its axes, else what BAROR or BEAMOR does.
NastranLineDetails ElementBuilder::line_details(const NastranElement& element) const {
  NastranLineDetails own = bulk_.lines[static_cast<std::size_t>(element.details)];
  if (own.has_orientation) return own;
  const NastranLineDetails& general =
      element.kind == Kind::bar ? bulk_.bar_defaults.line : bulk_.beam_defaults.line;
  if (!general.has_orientation) {
    fail(element, "the orientation vector is missing; give X1, X2, X3 or a node G0");
  }
  own.orientation_node = general.orientation_node;
  own.orientation = general.orientation;
  own.basic_orientation = general.basic_orientation;
  return own;
}

void ElementBuilder::add_hinges(const NastranElement& element, const NastranLineDetails& line,
                                int node_a) {
  const Vector3d along = position(nodes_[1]) - position(nodes_[0]);
  for (const std::size_t end : {0, 1}) {
    if (line.pins[end] == std::array<bool, 6>{}) continue;
    Matrix3d axes;
    axes.col(0) = along.normalized();
    axes.col(2) = up_direction(element, line, node_a, along, 0.0);
    axes.col(1) = axes.col(2).cross(axes.col(0));
    nodes_[end] = add_nastran_hinge(
        nodes_[end], axes, line.pins[end],
        fmt::format("pin {} of {} {}", end == 0 ? "PA" : "PB", name_of(element.kind), element.id),
        element.place.line, coordinates_, mesh_);
    notes_.add(fmt::format("{}: pin flags PA, PB become additional nodes, tied in the components "
                           "that are not released",
                           name_of(element.kind)),
               element.place);
  }
}

void ElementBuilder::add_line(const NastranElement& element) {
  const NastranLineDetails line = line_details(element);
  const int property = properties_.of(element, {});
  const int grid_a = nodes_[0];
  const Vector3d between = position(nodes_[1]) - position(nodes_[0]);
  const std::array<double, 2>& neutral = properties_.neutral_axis(property);
  const auto shift = [&](std::size_t end) -> Vector3d {
    const std::array<double, 3>& offset = end == 0 ? line.offset_a : line.offset_b;
    Vector3d local(offset[0], offset[1], offset[2]);
    const Vector3d across(0.0, neutral[0], neutral[1]);
    if (local.isZero(0.0) && across.isZero(0.0)) return local;
    Matrix3d axes;
    axes.col(0) = between.normalized();
    axes.col(2) = up_direction(element, line, grid_a, between, 0.0);
    axes.col(1) = axes.col(2).cross(axes.col(0));
    const Vector3d own = line.own_offsets[end]
                             ? Vector3d(axes * local)
                             : Vector3d(coordinates_.displacement_axes(nodes_[end]) * local);
    return own + axes * across;
  };
  const Vector3d shift_a = shift(0), shift_b = shift(1);
  nodes_[0] = shifted_end(nodes_[0], shift_a, element);
  nodes_[1] = shifted_end(nodes_[1], shift_b, element);
  add_hinges(element, line, grid_a);
  const Vector3d up = up_direction(element, line, grid_a, between + shift_b - shift_a,
                                   properties_.section_angle(property));
  fem::ImportedBlock& block = block_of(element, CellKind::line2, property);
  block.ids.push_back(element.id);
  block.nodes.insert(block.nodes.end(), nodes_.begin(), nodes_.end());
  block.up.push_back(up);
  spread_mass(element, property);
}

void ElementBuilder::spread_mass(const NastranElement& element, int property) {
  const std::size_t count = nodes_.size() == 2 ? 2 : corners_.size();
  if (count < 2) return;  // solids
  const double size =
      count == 2
          ? (position(nodes_[1]) - position(nodes_[0])).norm()
          : 0.5 * (corners_[2] - corners_[0]).cross(corners_[count - 1] - corners_[1]).norm();
  nonstructural_.add(element, std::span(nodes_).first(count), size,
                     properties_.nonstructural_mass(property));
}

/// @throws InputError if two elements have one number
void check_numbers(const NastranBulk& bulk) {
  std::vector<std::int64_t> ids;
  ids.reserve(bulk.elements.size());
  for (const NastranElement& element : bulk.elements) ids.push_back(element.id);
  const auto sorted = NastranIds(ids).sorted();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    const NastranElement& a = bulk.elements[static_cast<std::size_t>(sorted[i - 1].second)];
    const NastranElement& b = bulk.elements[static_cast<std::size_t>(sorted[i].second)];
    throw InputError(
        b.place.where(),
        fmt::format("{} {}: there is another element with this number: {} in {}:{}",
                    name_of(b.kind), b.id, name_of(a.kind), a.place.file->name, a.place.line));
  }
}

}  // namespace

std::vector<std::int64_t> add_nastran_elements(const NastranBulk& bulk,
                                               NastranCoordinates& coordinates,
                                               NastranProperties& properties,
                                               NastranNonstructuralMass& nonstructural,
                                               NastranNotes& notes, fem::ImportedMesh& mesh) {
  check_numbers(bulk);
  ElementBuilder builder(bulk, coordinates, properties, nonstructural, notes, mesh);
  for (const NastranElement& element : bulk.elements) builder.add(element);
  nonstructural.finish(mesh);
  std::vector<std::int64_t> ids;
  ids.reserve(bulk.elements.size());
  for (const fem::ImportedBlock& block : mesh.blocks) {
    ids.insert(ids.end(), block.ids.begin(), block.ids.end());
  }
  return ids;
}

}  // namespace buckens::mesh_io
