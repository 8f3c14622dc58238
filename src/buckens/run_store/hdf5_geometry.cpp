// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_geometry.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/name_index.h"
#include "buckens/run_store/hdf5_contact_shapes.h"
#include "buckens/run_store/hdf5_geometry_tables.h"
#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/hdf5_sections.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

using results::BodyKind;
using results::Geometry;
using results::GeometryBody;
using results::GeometryJoint;
using results::GeometryLoad;
using results::GeometryMarker;
using results::GeometrySide;

constexpr char kRoot[] = "/geometry";
constexpr char kBodies[] = "/geometry/bodies";
constexpr char kJoints[] = "/geometry/joints";
constexpr char kLoads[] = "/geometry/loads";
constexpr char kGround[] = "ground";

std::span<const double> numbers(const Eigen::Vector3d& v) { return {v.data(), 3}; }

Eigen::Vector3d vector_at(const std::vector<double>& values, std::size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

/// A damaged file must not make us read beyond a list.
void expect(const Hdf5File& file, const std::string& path, bool holds) {
  if (!holds) refuse(file, path, "does not have the form of a Buckens run");
}

void write_markers(const Hdf5File& file, const std::string& path,
                   const std::vector<GeometryMarker>& markers) {
  std::vector<std::string> names;
  std::vector<int> nodes;
  std::vector<double> positions, orientations;
  for (const GeometryMarker& marker : markers) {
    names.push_back(marker.name);
    nodes.push_back(marker.node);
    const Eigen::Vector3d& p = marker.X_BF.p;
    const Eigen::Quaterniond& q = marker.X_BF.q;
    positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    orientations.insert(orientations.end(), {q.w(), q.x(), q.y(), q.z()});
  }
  const hsize_t count = markers.size();
  write_dataset(file, path + "/marker_names", names);
  write_dataset(file, path + "/marker_nodes", {count}, nodes);
  write_dataset(file, path + "/marker_positions", {count, 3}, positions);
  write_attribute(file, path + "/marker_positions", "unit", std::string("m"));
  write_dataset(file, path + "/marker_orientations", {count, 4}, orientations);
  write_attribute(file, path + "/marker_orientations", "unit", std::string("1"));
  write_attribute(file, path + "/marker_orientations", "components",
                  std::vector<std::string>{"w", "x", "y", "z"});
}

constexpr std::array<const char*, 3> kKinds = {"rigid", "beam", "solid"};

BodyKind kind_of(const std::string& name) {
  const auto* at = std::find(kKinds.begin(), kKinds.end(), name);
  return at == kKinds.end() ? BodyKind::rigid : static_cast<BodyKind>(at - kKinds.begin());
}

void write_faces(const Hdf5File& file, const std::string& path, const GeometryBody& body) {
  if (body.faces.empty()) return;
  std::vector<int> faces;
  for (const auto& face : body.faces) faces.insert(faces.end(), face.begin(), face.end());
  write_dataset(file, path + "/faces", {body.faces.size(), 4}, faces);
  write_dataset(file, path + "/face_elements", {body.face_elements.size()}, body.face_elements);
}

constexpr auto kCellKinds = choice_names(fem::CellKind{});

void write_cells(const Hdf5File& file, const std::string& path, const GeometryBody& body) {
  if (!body.cell_kinds.empty()) {
    std::vector<int> kinds;
    for (const fem::CellKind kind : body.cell_kinds) kinds.push_back(static_cast<int>(kind));
    write_dataset(file, path + "/cell_kinds", {kinds.size()}, kinds);
    write_attribute(file, path + "/cell_kinds", "kinds",
                    std::vector<std::string>(kCellKinds.begin(), kCellKinds.end()));
    write_dataset(file, path + "/cell_nodes", {body.cell_nodes.size()}, body.cell_nodes);
  }
  const auto write = [&](const char* name, const std::vector<int>& values) {
    if (!values.empty()) write_dataset(file, path + "/" + name, {values.size()}, values);
  };
  write("field_nodes", body.field_nodes);
  write("field_elements", body.field_elements);
  write("cell_places", body.cell_places);
  if (body.face_places.empty()) return;
  std::vector<int> places;
  for (const auto& face : body.face_places) places.insert(places.end(), face.begin(), face.end());
  write_dataset(file, path + "/face_places", {body.face_places.size(), 4}, places);
}

/// A list of numbers from `least` on and below `end`; empty where it is missing.
std::vector<int> read_numbers(const Hdf5File& file, const std::string& path, int least, int end,
                              std::size_t columns = 1) {
  if (!has_object(file, path)) return {};
  std::vector<int> values = read_int_dataset(file, path, columns);
  for (const int value : values) expect(file, path, value >= least && value < end);
  return values;
}

void read_cells(const Hdf5File& file, const std::string& path, GeometryBody& body) {
  const auto num_nodes = static_cast<int>(body.nodes.rows());
  std::size_t count = 0;
  const auto num_kinds = static_cast<int>(kCellKinds.size());
  for (const int kind : read_numbers(file, path + "/cell_kinds", 0, num_kinds)) {
    body.cell_kinds.push_back(static_cast<fem::CellKind>(kind));
    count += static_cast<std::size_t>(fem::num_nodes(body.cell_kinds.back()));
  }
  body.cell_nodes = read_numbers(file, path + "/cell_nodes", 0, num_nodes);
  expect(file, path, body.cell_nodes.size() == count);
  body.field_nodes = read_numbers(file, path + "/field_nodes", 0, num_nodes);
  const auto cells = static_cast<int>(body.cell_kinds.size());
  body.field_elements = read_numbers(file, path + "/field_elements", 0, cells);
  const auto num_places = static_cast<int>(body.field_nodes.size());
  const std::vector<int> places = read_numbers(file, path + "/face_places", -1, num_places, 4);
  expect(file, path, places.empty() || places.size() == 4 * body.faces.size());
  body.cell_places = read_numbers(file, path + "/cell_places", -1, num_places);
  expect(file, path, body.cell_places.empty() || body.cell_places.size() == count);
  for (const int element : body.face_elements) expect(file, path, cells == 0 || element < cells);
  for (std::size_t i = 0; i < places.size(); i += 4) {
    body.face_places.push_back({places[i], places[i + 1], places[i + 2], places[i + 3]});
  }
}

void read_faces(const Hdf5File& file, const std::string& path, GeometryBody& body) {
  if (!has_object(file, path + "/faces")) return;
  const std::vector<int> faces = read_int_dataset(file, path + "/faces", 4);
  body.face_elements = read_int_dataset(file, path + "/face_elements");
  expect(file, path, faces.size() == 4 * body.face_elements.size());
  for (std::size_t i = 0; i < faces.size(); i += 4) {
    const std::array<int, 4> face{faces[i], faces[i + 1], faces[i + 2], faces[i + 3]};
    for (std::size_t k = 0; k < 4; ++k) {
      expect(file, path, face[k] >= (k < 3 ? 0 : -1) && face[k] < body.nodes.rows());
    }
    expect(file, path, body.face_elements[i / 4] >= 0);
    body.faces.push_back(face);
  }
}

void write_body(const Hdf5File& file, int index, const GeometryBody& body) {
  const std::string path = fmt::format("{}/{}", kBodies, body.name);
  create_group(file, path);
  write_attribute(file, path, "index", index);
  write_attribute(file, path, "kind", std::string(kKinds[static_cast<std::size_t>(body.kind)]));
  const std::span<const double> nodes(body.nodes.data(),
                                      static_cast<std::size_t>(body.nodes.size()));
  write_dataset(file, path + "/nodes", {static_cast<hsize_t>(body.nodes.rows()), 3}, nodes);
  write_attribute(file, path + "/nodes", "unit", std::string("m"));
  std::vector<int> elements;
  for (const auto& element : body.elements) {
    elements.insert(elements.end(), element.begin(), element.end());
  }
  write_dataset(file, path + "/elements", {body.elements.size(), 2}, elements);
  std::vector<double> radius;
  for (const auto& ends : body.radius) radius.insert(radius.end(), ends.begin(), ends.end());
  write_dataset(file, path + "/radius", {body.radius.size(), 2}, radius);
  write_attribute(file, path + "/radius", "unit", std::string("m"));
  write_sections(file, path, body);
  write_faces(file, path, body);
  write_cells(file, path, body);
  write_markers(file, path, body.markers);
}

void write_joint(const Hdf5File& file, int index, const Geometry& geometry,
                 const GeometryJoint& joint) {
  const std::string path = fmt::format("{}/{}", kJoints, joint.name);
  create_group(file, path);
  write_attribute(file, path, "index", index);
  write_attribute(file, path, "type", joint.type);
  write_attribute(file, path, "axis", numbers(joint.axis));
  std::vector<std::string> bodies, markers;
  std::vector<double> positions;
  for (const GeometrySide& side : joint.between) {
    const GeometryBody* body =
        side.body < 0 ? nullptr : &geometry.bodies.at(static_cast<std::size_t>(side.body));
    bodies.push_back(body == nullptr ? kGround : body->name);
    markers.push_back(body == nullptr || side.marker < 0
                          ? ""
                          : body->markers.at(static_cast<std::size_t>(side.marker)).name);
    positions.insert(positions.end(), side.position.data(), side.position.data() + 3);
  }
  write_attribute(file, path, "bodies", bodies);
  write_attribute(file, path, "markers", markers);
  write_dataset(file, path + "/positions", {2, 3}, positions);
  write_attribute(file, path + "/positions", "unit", std::string("m"));
}

std::vector<double> flat(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<double> out;
  for (const Eigen::Vector3d& v : vectors) out.insert(out.end(), {v.x(), v.y(), v.z()});
  return out;
}

void write_load(const Hdf5File& file, int index, const Geometry& geometry,
                const GeometryLoad& load) {
  const std::string path = fmt::format("{}/{}", kLoads, load.name);
  create_group(file, path);
  write_attribute(file, path, "index", index);
  write_attribute(file, path, "kind", load.kind);
  write_attribute(
      file, path, "body",
      load.body < 0 ? kGround : geometry.bodies.at(static_cast<std::size_t>(load.body)).name);
  write_attribute(file, path, "follows", load.follows ? 1 : 0);
  write_attribute(file, path, "unit", load.unit);
  const hsize_t count = load.positions.size();
  write_dataset(file, path + "/positions", {count, 3}, flat(load.positions));
  write_attribute(file, path + "/positions", "unit", std::string("m"));
  write_dataset(file, path + "/nodes", {count}, load.nodes);
  if (load.directions.empty()) return;
  write_dataset(file, path + "/directions", {count, 3}, flat(load.directions));
}

/// Names of the groups in the order in which they were written.
std::vector<std::string> in_order(const Hdf5File& file, const std::string& path) {
  std::vector<std::pair<int, std::string>> found;
  if (!has_object(file, path)) return {};
  for (std::string& name : list_objects(file, path)) {
    const std::vector<int> index = read_ints(file, path + "/" + name, "index");
    expect(file, path, index.size() == 1);
    found.emplace_back(index[0], std::move(name));
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  for (auto& [index, name] : found) names.push_back(std::move(name));
  return names;
}

std::vector<GeometryMarker> read_markers(const Hdf5File& file, const std::string& path,
                                         int num_nodes) {
  const std::vector<std::string> names = read_string_dataset(file, path + "/marker_names");
  const std::vector<int> nodes = read_numbers(file, path + "/marker_nodes", -1, num_nodes);
  const std::vector<double> p = read_double_dataset(file, path + "/marker_positions", 3);
  const std::vector<double> q = read_double_dataset(file, path + "/marker_orientations", 4);
  const std::size_t count = names.size();
  expect(file, path, nodes.size() == count && p.size() == 3 * count && q.size() == 4 * count);
  std::vector<GeometryMarker> markers(count);
  for (std::size_t i = 0; i < count; ++i) {
    markers[i].name = names[i];
    markers[i].node = nodes[i];
    markers[i].X_BF.p = vector_at(p, i);
    markers[i].X_BF.q = Eigen::Quaterniond(q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]);
  }
  return markers;
}

GeometryBody read_body(const Hdf5File& file, const std::string& name) {
  const std::string path = fmt::format("{}/{}", kBodies, name);
  GeometryBody body;
  body.name = name;
  body.kind = kind_of(read_string(file, path, "kind"));
  const std::vector<double> nodes = read_double_dataset(file, path + "/nodes", 3);
  const std::vector<int> elements = read_int_dataset(file, path + "/elements", 2);
  const std::vector<double> radius = read_double_dataset(file, path + "/radius", 2);
  expect(file, path, radius.size() == elements.size());
  for (std::size_t e = 0; e < radius.size(); e += 2) {
    body.radius.push_back({radius[e], radius[e + 1]});
  }
  const auto num_nodes = static_cast<int>(nodes.size() / 3);
  body.nodes.resize(num_nodes, 3);
  std::copy(nodes.begin(), nodes.end(), body.nodes.data());
  for (std::size_t i = 0; i < elements.size(); i += 2) {
    const std::array<int, 2> pair{elements[i], elements[i + 1]};
    for (const int node : pair) expect(file, path, node >= 0 && node < num_nodes);
    body.elements.push_back(pair);
  }
  read_sections(file, path, body);
  read_faces(file, path, body);
  read_cells(file, path, body);
  body.markers = read_markers(file, path, num_nodes);
  return body;
}

template <typename Named>
int index_of(const std::vector<Named>& list, const std::string& name) {
  const auto at = std::find_if(list.begin(), list.end(),
                               [&](const Named& entry) { return entry.name == name; });
  return at == list.end() ? -1 : static_cast<int>(at - list.begin());
}

/// The same of bodies, of which there may be thousands.
int body_called(const Geometry& geometry, base::NameIndex& index, const std::string& name) {
  const GeometryBody* found = index.find(geometry.bodies, name);
  return found == nullptr ? -1 : static_cast<int>(found - geometry.bodies.data());
}

GeometryJoint read_joint(const Hdf5File& file, const Geometry& geometry, base::NameIndex& index,
                         const std::string& name) {
  const std::string path = fmt::format("{}/{}", kJoints, name);
  GeometryJoint joint;
  joint.name = name;
  joint.type = read_string(file, path, "type");
  const std::vector<double> axis = read_doubles(file, path, "axis");
  const std::vector<std::string> bodies = read_strings(file, path, "bodies");
  const std::vector<std::string> markers = read_strings(file, path, "markers");
  const std::vector<double> positions = read_double_dataset(file, path + "/positions", 3);
  expect(file, path,
         axis.size() == 3 && bodies.size() == 2 && markers.size() == 2 && positions.size() == 6);
  joint.axis = vector_at(axis, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    GeometrySide& side = joint.between[i];
    side.body =
        bodies[i] == kGround ? results::kGroundBody : body_called(geometry, index, bodies[i]);
    expect(file, path, side.body >= 0 || bodies[i] == kGround);
    if (side.body >= 0 && !markers[i].empty()) {
      const auto& body = geometry.bodies[static_cast<std::size_t>(side.body)];
      side.marker = index_of(body.markers, markers[i]);
    }
    side.position = vector_at(positions, i);
  }
  return joint;
}

std::vector<Eigen::Vector3d> vectors_at(const Hdf5File& file, const std::string& path) {
  const std::vector<double> values = read_double_dataset(file, path, 3);
  std::vector<Eigen::Vector3d> out;
  for (std::size_t k = 0; k < values.size() / 3; ++k) out.push_back(vector_at(values, k));
  return out;
}

GeometryLoad read_load(const Hdf5File& file, const Geometry& geometry, base::NameIndex& index,
                       const std::string& name) {
  const std::string path = fmt::format("{}/{}", kLoads, name);
  GeometryLoad load;
  load.name = name;
  load.kind = read_string(file, path, "kind");
  const std::string body = read_string(file, path, "body");
  load.body = body == kGround ? results::kGroundBody : body_called(geometry, index, body);
  expect(file, path, load.body >= 0 || body == kGround);
  const std::vector<int> follows = read_ints(file, path, "follows");
  expect(file, path, follows.size() == 1);
  load.follows = follows[0] != 0;
  load.unit = read_string(file, path, "unit");
  load.positions = vectors_at(file, path + "/positions");
  // Nodes of a load on all bodies mean nothing.
  const Eigen::Index num_nodes =
      load.body < 0 ? std::numeric_limits<int>::max()
                    : geometry.bodies[static_cast<std::size_t>(load.body)].nodes.rows();
  load.nodes = read_numbers(file, path + "/nodes", -1, static_cast<int>(num_nodes));
  if (has_object(file, path + "/directions")) {
    load.directions = vectors_at(file, path + "/directions");
  }
  expect(file, path,
         load.nodes.size() == load.positions.size() &&
             (load.directions.empty() || load.directions.size() == load.positions.size()));
  return load;
}

}  // namespace

void write_geometry(const Hdf5File& file, const Geometry& geometry, bool in_tables) {
  create_group(file, kRoot);
  write_attribute(file, kRoot, "gravity", numbers(geometry.gravity));
  write_attribute(file, kRoot, "gravity_unit", std::string("m/s^2"));
  write_attribute(file, kRoot, "planar", geometry.planar);
  int index = 0;
  if (in_tables) {
    write_geometry_tables(file, geometry);
  } else {
    create_group(file, kBodies);
    create_group(file, kJoints);
    for (const GeometryBody& body : geometry.bodies) write_body(file, index++, body);
    index = 0;
    for (const GeometryJoint& joint : geometry.joints) write_joint(file, index++, geometry, joint);
  }
  create_group(file, kLoads);
  index = 0;
  for (const GeometryLoad& load : geometry.loads) write_load(file, index++, geometry, load);
  write_shapes(file, geometry);
  write_cables(file, geometry);
}

Geometry read_geometry(const Hdf5File& file) {
  expect(file, kRoot, kind_of_object(file, kRoot) == Hdf5Kind::group);
  Geometry geometry;
  const std::vector<double> gravity = read_doubles(file, kRoot, "gravity");
  expect(file, kRoot, gravity.size() == 3);
  geometry.gravity = vector_at(gravity, 0);
  geometry.planar = read_string(file, kRoot, "planar");
  base::NameIndex bodies;
  if (!read_geometry_tables(file, geometry)) {
    for (const std::string& name : in_order(file, kBodies)) {
      geometry.bodies.push_back(read_body(file, name));
    }
    for (const std::string& name : in_order(file, kJoints)) {
      geometry.joints.push_back(read_joint(file, geometry, bodies, name));
    }
  }
  for (const std::string& name : in_order(file, kLoads)) {
    geometry.loads.push_back(read_load(file, geometry, bodies, name));
  }
  read_shapes(file, geometry);
  read_cables(file, geometry);
  return geometry;
}

}  // namespace buckens::run_store
