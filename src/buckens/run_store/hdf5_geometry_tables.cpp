// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_geometry_tables.h"

#include <string>
#include <utility>
#include <vector>

#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

const std::string kTables = "/geometry/tables";

void require_form(const Hdf5File& file, bool holds) {
  if (!holds) refuse(file, kTables, "does not have the form of a Buckens run");
}

void push(const Eigen::Vector3d& v, std::vector<double>& to) {
  to.insert(to.end(), {v.x(), v.y(), v.z()});
}

Eigen::Vector3d three_at(const std::vector<double>& values, std::size_t at) {
  return {values[at], values[at + 1], values[at + 2]};
}

void write_body_rows(const Hdf5File& file, const std::vector<results::GeometryBody>& bodies) {
  std::vector<std::string> names, markers;
  std::vector<int> counts;
  std::vector<double> positions, orientations;
  for (const results::GeometryBody& body : bodies) {
    names.push_back(body.name);
    counts.push_back(static_cast<int>(body.markers.size()));
    for (const results::GeometryMarker& marker : body.markers) {
      markers.push_back(marker.name);
      push(marker.X_BF.p, positions);
      const Eigen::Quaterniond& q = marker.X_BF.q;
      orientations.insert(orientations.end(), {q.w(), q.x(), q.y(), q.z()});
    }
  }
  write_dataset(file, kTables + "/body_names", names);
  write_dataset(file, kTables + "/marker_counts", {counts.size()}, counts);
  write_dataset(file, kTables + "/marker_names", markers);
  write_dataset(file, kTables + "/marker_positions", {markers.size(), 3}, positions);
  write_attribute(file, kTables + "/marker_positions", "unit", std::string("m"));
  write_dataset(file, kTables + "/marker_orientations", {markers.size(), 4}, orientations);
  write_attribute(file, kTables + "/marker_orientations", "components",
                  std::vector<std::string>{"w", "x", "y", "z"});
}

void write_joint_rows(const Hdf5File& file, const std::vector<results::GeometryJoint>& joints) {
  std::vector<std::string> names, types;
  std::vector<int> sides;
  std::vector<double> axes, positions;
  for (const results::GeometryJoint& joint : joints) {
    names.push_back(joint.name);
    types.push_back(joint.type);
    push(joint.axis, axes);
    for (const results::GeometrySide& side : joint.between) {
      sides.insert(sides.end(), {side.body, side.marker});
      push(side.position, positions);
    }
  }
  write_dataset(file, kTables + "/joint_names", names);
  write_dataset(file, kTables + "/joint_types", types);
  write_dataset(file, kTables + "/joint_sides", {names.size(), 4}, sides);
  write_dataset(file, kTables + "/joint_axes", {names.size(), 3}, axes);
  write_dataset(file, kTables + "/joint_positions", {names.size(), 6}, positions);
  write_attribute(file, kTables + "/joint_positions", "unit", std::string("m"));
}

std::vector<results::GeometryBody> read_body_rows(const Hdf5File& file) {
  std::vector<std::string> names = read_string_dataset(file, kTables + "/body_names");
  const std::vector<int> counts = read_int_dataset(file, kTables + "/marker_counts");
  std::vector<std::string> markers = read_string_dataset(file, kTables + "/marker_names");
  const std::vector<double> p = read_double_dataset(file, kTables + "/marker_positions", 3);
  const std::vector<double> q = read_double_dataset(file, kTables + "/marker_orientations", 4);
  const std::size_t total = markers.size();
  require_form(file,
               counts.size() == names.size() && p.size() == 3 * total && q.size() == 4 * total);
  std::vector<results::GeometryBody> bodies(names.size());
  std::size_t m = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    require_form(file, counts[b] >= 0 && static_cast<std::size_t>(counts[b]) <= total - m);
    bodies[b].name = std::move(names[b]);
    for (const std::size_t end = m + static_cast<std::size_t>(counts[b]); m < end; ++m) {
      const Eigen::Quaterniond turn(q[4 * m], q[4 * m + 1], q[4 * m + 2], q[4 * m + 3]);
      bodies[b].markers.push_back({std::move(markers[m]), -1, {three_at(p, 3 * m), turn}});
    }
  }
  return bodies;
}

results::GeometrySide side_from(const Hdf5File& file, const results::Geometry& geometry,
                                const int* numbers, const Eigen::Vector3d& position) {
  const results::GeometrySide side{numbers[0], numbers[1], position};
  const auto bodies = static_cast<int>(geometry.bodies.size());
  require_form(file, side.body >= results::kGroundBody && side.body < bodies);
  const std::size_t markers =
      side.body < 0 ? 0 : geometry.bodies[static_cast<std::size_t>(side.body)].markers.size();
  require_form(file, side.marker >= -1 && side.marker < static_cast<int>(markers));
  return side;
}

std::vector<results::GeometryJoint> read_joint_rows(const Hdf5File& file,
                                                    const results::Geometry& geometry) {
  std::vector<std::string> names = read_string_dataset(file, kTables + "/joint_names");
  std::vector<std::string> types = read_string_dataset(file, kTables + "/joint_types");
  const std::vector<int> sides = read_int_dataset(file, kTables + "/joint_sides", 4);
  const std::vector<double> axes = read_double_dataset(file, kTables + "/joint_axes", 3);
  const std::vector<double> positions = read_double_dataset(file, kTables + "/joint_positions", 6);
  const std::size_t count = names.size();
  require_form(file, types.size() == count && sides.size() == 4 * count &&
                         axes.size() == 3 * count && positions.size() == 6 * count);
  std::vector<results::GeometryJoint> joints(count);
  for (std::size_t j = 0; j < count; ++j) {
    joints[j].name = std::move(names[j]);
    joints[j].type = std::move(types[j]);
    joints[j].axis = three_at(axes, 3 * j);
    for (std::size_t i = 0; i < 2; ++i) {
      joints[j].between[i] = side_from(file, geometry, sides.data() + 4 * j + 2 * i,
                                       three_at(positions, 6 * j + 3 * i));
    }
  }
  return joints;
}

}  // namespace

void write_geometry_tables(const Hdf5File& file, const results::Geometry& geometry) {
  create_group(file, kTables);
  write_body_rows(file, geometry.bodies);
  if (!geometry.joints.empty()) write_joint_rows(file, geometry.joints);
}

bool read_geometry_tables(const Hdf5File& file, results::Geometry& geometry) {
  if (!has_object(file, kTables)) return false;
  geometry.bodies = read_body_rows(file);
  if (has_object(file, kTables + "/joint_names")) geometry.joints = read_joint_rows(file, geometry);
  return true;
}

}  // namespace buckens::run_store
