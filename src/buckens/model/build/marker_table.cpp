// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/marker_table.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/solid/recovery.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {
// A position counts as on the mesh within this share of the element length, or, at nodes of solids,
// of the distance to the next node.
constexpr double kOnMesh = 1e-6;

struct NearNode {
  int node = -1;
  double distance = HUGE_VAL;
  double next = HUGE_VAL;  ///< distance of the second nearest node
};

NearNode nearest_node(const std::vector<fem::Node>& nodes, const Vector3d& position) {
  NearNode out;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double distance = (nodes[k].position - position).norm();
    if (distance < out.distance) {
      out = {static_cast<int>(k), distance, out.distance};
    } else {
      out.next = std::min(out.next, distance);
    }
  }
  return out;
}

std::string at_point(const Vector3d& p) {
  return fmt::format("({:g}, {:g}, {:g}) m", p.x(), p.y(), p.z());
}
}  // namespace

MarkerTable::MarkerTable(const body::BodySpec& spec, body::Body& body, const NamedStructure* mesh,
                         const std::optional<Vector3d>& whole_com)
    : spec_(spec), body_(body), mesh_(mesh), whole_com_(whole_com) {}

std::vector<std::string> MarkerTable::names() const {
  std::vector<std::string> out = {"com", "origin"};
  if (mesh_ != nullptr) out.insert(out.end(), mesh_->names.begin(), mesh_->names.end());
  for (const body::InterfaceSpec& interface : spec_.interfaces) out.push_back(interface.name);
  for (const body::MarkerSpec& marker : spec_.markers) out.push_back(marker.name);
  return out;
}

std::string MarkerTable::suggestion(const std::string& name) const {
  const std::string near = base::nearest(name, names());
  return near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near);
}

std::optional<MeshPlace> MarkerTable::place_at(const Vector3d& position) const {
  const fem::FeModel& fe = body_.flexible->mesh();
  const auto lines = fem::line_elements(fe);
  for (std::size_t e = 0; e < lines.size(); ++e) {
    const Vector3d a = fe.nodes[static_cast<std::size_t>(lines[e].a)].position;
    const Vector3d b = fe.nodes[static_cast<std::size_t>(lines[e].b)].position;
    const double length = (b - a).norm();
    const double xi = (position - a).dot(b - a) / (length * length);
    if (xi < -kOnMesh || xi > 1.0 + kOnMesh) continue;
    if ((position - a - xi * (b - a)).norm() > kOnMesh * length) continue;
    if (xi < kOnMesh) return MeshPlace{lines[e].a, -1, 0};
    if (xi > 1.0 - kOnMesh) return MeshPlace{lines[e].b, -1, 0};
    return MeshPlace{-1, static_cast<int>(e), xi};
  }
  const bool is_matrices = fe.blocks.empty();
  if (fem::num_solids(fe) == 0 && !is_matrices) return std::nullopt;
  const NearNode near = nearest_node(fe.nodes, position);
  if (near.distance <= kOnMesh * near.next) return MeshPlace{near.node, -1, 0};
  return std::nullopt;
}

MarkerTable::Target MarkerTable::named(const std::string& name, const base::MarkerRef& ref) const {
  if (name.empty() || name == "com") {
    if (!whole_com_) return {body_.com, Eigen::Quaterniond::Identity(), {}, nullptr};
    return {*whole_com_, Eigen::Quaterniond::Identity(), place_at(*whole_com_), nullptr};
  }
  if (mesh_ != nullptr) {
    if (const auto place = mesh_->find(name)) {
      const fem::FeModel& fe = body_.flexible->mesh();
      const fem::PointRows rows = place->node >= 0 ? fem::node_rows(fe, place->node)
                                                   : fem::point_rows(fe, place->element, place->xi);
      return {rows.position, Eigen::Quaterniond::Identity(), place, nullptr};
    }
    if (const InterfaceRegion* interface = mesh_->find_interface(name)) {
      return {interface->at, interface->orientation, {}, interface};
    }
  }
  if (name == "origin") {
    const Vector3d origin = Vector3d::Zero();
    return {origin, Eigen::Quaterniond::Identity(),
            mesh_ != nullptr ? place_at(origin) : std::nullopt, nullptr};
  }
  throw InputError(ref.where,
                   fmt::format("body \"{}\" has no marker \"{}\"{}; markers there: {}", spec_.name,
                               name, suggestion(name), fmt::join(names(), ", ")));
}

std::optional<MeshPlace> MarkerTable::find_place(const std::string& name) const {
  if (mesh_ == nullptr) return std::nullopt;
  if (const body::MarkerSpec* own = base::find_named(spec_.markers, name)) {
    return own->position ? place_at(*own->position) : find_place(own->at);
  }
  if (name.empty() || name == "com") return place_at(whole_com_.value_or(body_.com));
  if (const auto place = mesh_->find(name)) return place;
  return name == "origin" ? place_at(Vector3d::Zero()) : std::nullopt;
}

const InterfaceRegion* MarkerTable::interface(const std::string& marker) const {
  if (mesh_ == nullptr) return nullptr;
  const body::MarkerSpec* own = base::find_named(spec_.markers, marker);
  return mesh_->find_interface(own != nullptr ? own->at : marker);
}

bool MarkerTable::holds(const std::string& name) const {
  return interface(name) != nullptr || find_place(name).has_value();
}

double MarkerTable::distance(const std::string& name) const {
  const body::MarkerSpec* own = base::find_named(spec_.markers, name);
  if (own != nullptr && !own->position) return distance(own->at);
  Vector3d position = Vector3d::Zero();
  if (own != nullptr) {
    position = *own->position;
  } else if (name.empty() || name == "com") {
    position = whole_com_.value_or(body_.com);
  } else if (name != "origin") {
    return HUGE_VAL;
  }
  double least = HUGE_VAL;
  for (const auto& node : mesh_->structure.nodes) {
    least = std::min(least, (node.position - position).norm());
  }
  return least;
}

int MarkerTable::cut_marker(int node) {
  const std::string name = fmt::format("#{}", node);
  const auto known = found_.find(name);
  if (known != found_.end()) return known->second;
  const Vector3d position =
      body_.flexible->mesh().nodes.at(static_cast<std::size_t>(node)).position;
  return add(name, {position, Eigen::Quaterniond::Identity(), MeshPlace{node, -1, 0}, nullptr});
}

int MarkerTable::add_region(const std::string& name, const std::optional<Vector3d>& position,
                            const std::vector<linalg::Triplet>& rows) {
  body::Marker marker;
  marker.name = name;
  if (position) {
    marker.X_BF.p = *position - body_.com;
    marker.translation_row = num_rows_;
    marker.node = nearest_node(body_.flexible->mesh().nodes, *position).node;
    add_entries(rows, num_rows_);
    num_rows_ += 3;
  }
  const int index = static_cast<int>(body_.markers.size());
  body_.markers.push_back(marker);
  found_.emplace(name, index);
  return index;
}

int MarkerTable::add_pattern(const std::vector<linalg::Triplet>& entries) {
  add_entries(entries, num_rows_);
  return num_rows_++;
}

std::optional<MeshPlace> MarkerTable::place(const base::MarkerRef& ref) const {
  return target(ref).place;
}

void MarkerTable::refuse_place(const body::MarkerSpec& marker) const {
  const fem::FeModel& fe = body_.flexible->mesh();
  const NearNode near = nearest_node(fe.nodes, *marker.position);
  const Vector3d& at = fe.nodes.at(static_cast<std::size_t>(near.node)).position;
  throw InputError(marker.where,
                   fmt::format("marker \"{}\" of body \"{}\" at {} does not lie on its mesh; the "
                               "nearest node lies at {}, {:.3g} m away. Put it on a node or on a "
                               "beam or bar, or divide the mesh so that a node lies there",
                               marker.name, spec_.name, at_point(*marker.position), at_point(at),
                               near.distance));
}

MarkerTable::Target MarkerTable::target(const base::MarkerRef& ref) const {
  const body::MarkerSpec* own = base::find_named(spec_.markers, ref.marker);
  if (own == nullptr) return named(ref.marker, ref);
  Target target;
  if (own->position) {
    target = {
        *own->position, {}, mesh_ != nullptr ? place_at(*own->position) : std::nullopt, nullptr};
    if (mesh_ != nullptr && !target.place) refuse_place(*own);
  } else {
    base::MarkerRef at = ref;
    at.where = own->where;
    target = named(own->at, at);
  }
  target.orientation = own->rotation();
  return target;
}

void MarkerTable::add_entries(const std::vector<linalg::Triplet>& entries, int first) {
  for (const auto& entry : entries) {
    entries_.emplace_back(first + entry.row(), entry.col(), entry.value());
  }
}

std::pair<int, int> MarkerTable::add_rows(const fem::PointRows& rows) {
  std::pair<int, int> first{num_rows_, -1};
  add_entries(rows.translation, num_rows_);
  num_rows_ += 3;
  if (rows.has_rotation) {
    first.second = num_rows_;
    add_entries(rows.rotation, num_rows_);
    num_rows_ += 3;
  }
  return first;
}

std::pair<int, int> MarkerTable::rows_at(const MeshPlace& place) {
  const auto key = std::make_tuple(place.node, place.element, place.xi);
  if (const auto known = rows_of_place_.find(key); known != rows_of_place_.end()) {
    return known->second;
  }
  const fem::FeModel& fe = body_.flexible->mesh();
  return rows_of_place_[key] =
             add_rows(place.node >= 0 ? fem::node_rows(fe, place.node)
                                      : fem::point_rows(fe, place.element, place.xi));
}

std::pair<int, int> MarkerTable::rows_of(const InterfaceRegion& interface) {
  const auto known = rows_of_interface_.find(interface.name);
  if (known != rows_of_interface_.end()) return known->second;
  return rows_of_interface_[interface.name] =
             add_rows(fem::region_rows(body_.flexible->mesh(), interface.region, interface.at));
}

int MarkerTable::add(const std::string& name, const Target& where) {
  body::Marker marker;
  marker.name = name;
  marker.X_BF = {where.position - body_.com, where.orientation};
  if (where.interface != nullptr) {
    std::tie(marker.translation_row, marker.rotation_row) = rows_of(*where.interface);
    marker.node = nearest_of(where.interface->region.nodes, where.position);
  } else if (where.place) {
    std::tie(marker.translation_row, marker.rotation_row) = rows_at(*where.place);
    marker.node = where.place->node;
  }
  const int index = static_cast<int>(body_.markers.size());
  body_.markers.push_back(marker);
  found_.emplace(name, index);
  return index;
}

int MarkerTable::nearest_of(const std::vector<int>& nodes, const Vector3d& position) const {
  const auto& all = body_.flexible->mesh().nodes;
  const auto distance = [&](int node) {
    return (all[static_cast<std::size_t>(node)].position - position).squaredNorm();
  };
  return *std::min_element(nodes.begin(), nodes.end(),
                           [&](int a, int b) { return distance(a) < distance(b); });
}

std::string MarkerTable::mesh_points() const {
  std::vector<std::string> points = mesh_->names;
  for (const InterfaceRegion& interface : mesh_->interfaces) points.push_back(interface.name);
  for (const body::MarkerSpec& own : spec_.markers) {
    if (holds(own.name)) points.push_back(own.name);
  }
  if (!points.empty()) return fmt::format("use one of: {}", fmt::join(points, ", "));
  if (mesh_->numbers.empty()) return "define an interface on its mesh";
  return fmt::format("define an interface, or use a node of the file such as \"n{}\"",
                     mesh_->numbers.begin()->first);
}

int MarkerTable::find(const base::MarkerRef& ref, bool needs_mesh) {
  const std::string name = ref.marker.empty() ? "com" : ref.marker;
  const auto known = found_.find(name);
  int index = known == found_.end() ? -1 : known->second;
  if (index < 0) index = add(name, target(ref));
  if (needs_mesh && mesh_ != nullptr &&
      !body_.markers[static_cast<std::size_t>(index)].follows_mesh()) {
    throw InputError(ref.where, fmt::format("\"{}\" is not a point of the mesh of the flexible "
                                            "body \"{}\": a force there would act on nothing; {}",
                                            ref.text, spec_.name, mesh_points()));
  }
  return index;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> MarkerTable::rows() const {
  if (!body_.is_flexible()) return {};
  Eigen::SparseMatrix<double, Eigen::RowMajor> N(num_rows_, body_.flexible->mesh().dofs.num_dofs);
  std::vector<linalg::Triplet> kept;
  for (const auto& entry : entries_) {
    if (entry.col() >= 0) kept.push_back(entry);
  }
  N.setFromTriplets(kept.begin(), kept.end());
  return body_.flexible->recovery.rows(N);
}

}  // namespace buckens::model
