// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_contact_shapes.h"

#include <string>
#include <vector>

#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

using results::Geometry;
using results::GeometryCable;
using results::GeometryShape;
using results::GeometrySide;

constexpr char kShapes[] = "/geometry/shapes";
constexpr char kCables[] = "/geometry/cables";
// Of a shape: place, orientation w x y z, axis, radius, length, edges.
constexpr std::size_t kShapeNumbers = 15;

void expect_shapes(const Hdf5File& file, const std::string& path, bool holds) {
  if (!holds) refuse(file, path, "does not have the form of a Buckens run");
}

void append(const Eigen::Vector3d& v, std::vector<double>& out) {
  out.insert(out.end(), {v.x(), v.y(), v.z()});
}

Eigen::Vector3d vector_in(const std::vector<double>& values, std::size_t at) {
  return {values[at], values[at + 1], values[at + 2]};
}

/// Body and marker of a place; a damaged file must not make us read beyond a list.
GeometrySide side_in(const Hdf5File& file, const std::string& path, const Geometry& geometry,
                     const int* numbers, const Eigen::Vector3d& position) {
  GeometrySide out{numbers[0], numbers[1], position};
  const auto bodies = static_cast<int>(geometry.bodies.size());
  expect_shapes(file, path, out.body >= results::kGroundBody && out.body < bodies);
  const std::size_t markers =
      out.body < 0 ? 0 : geometry.bodies[static_cast<std::size_t>(out.body)].markers.size();
  expect_shapes(file, path, out.marker >= -1 && out.marker < static_cast<int>(markers));
  return out;
}

}  // namespace

void write_shapes(const Hdf5File& file, const Geometry& geometry) {
  if (geometry.shapes.empty()) return;
  std::vector<std::string> names, kinds;
  std::vector<int> places, counts, triangles;
  std::vector<double> numbers, points;
  for (const GeometryShape& shape : geometry.shapes) {
    names.push_back(shape.name);
    kinds.push_back(shape.kind);
    places.insert(places.end(), {shape.on.body, shape.on.marker});
    append(shape.on.position, numbers);
    numbers.insert(numbers.end(), {shape.q.w(), shape.q.x(), shape.q.y(), shape.q.z()});
    append(shape.axis, numbers);
    numbers.insert(numbers.end(), {shape.radius, shape.length});
    append(shape.size, numbers);
    counts.insert(counts.end(), {static_cast<int>(shape.points.size()),
                                 static_cast<int>(shape.triangles.size())});
    for (const Eigen::Vector3d& point : shape.points) append(point, points);
    for (const auto& t : shape.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  }
  const std::string root = kShapes;
  create_group(file, root);
  const hsize_t count = names.size();
  write_dataset(file, root + "/contacts", names);
  write_dataset(file, root + "/kinds", kinds);
  write_dataset(file, root + "/places", {count, 2}, places);
  write_dataset(file, root + "/numbers", {count, kShapeNumbers}, numbers);
  if (points.empty()) return;
  write_dataset(file, root + "/counts", {count, 2}, counts);
  write_dataset(file, root + "/points", {points.size() / 3, 3}, points);
  write_attribute(file, root + "/points", "unit", std::string("m"));
  write_dataset(file, root + "/triangles", {triangles.size() / 3, 3}, triangles);
}

void read_shapes(const Hdf5File& file, Geometry& geometry) {
  const std::string root = kShapes;
  if (!has_object(file, root)) return;
  const std::vector<std::string> names = read_string_dataset(file, root + "/contacts");
  const std::vector<std::string> kinds = read_string_dataset(file, root + "/kinds");
  const std::vector<int> places = read_int_dataset(file, root + "/places", 2);
  const std::vector<double> numbers = read_double_dataset(file, root + "/numbers", kShapeNumbers);
  expect_shapes(file, root,
                kinds.size() == names.size() && places.size() == 2 * names.size() &&
                    numbers.size() == kShapeNumbers * names.size());
  std::vector<int> counts(2 * names.size(), 0), triangles;
  std::vector<double> points;
  if (has_object(file, root + "/counts")) {
    counts = read_int_dataset(file, root + "/counts", 2);
    points = read_double_dataset(file, root + "/points", 3);
    triangles = read_int_dataset(file, root + "/triangles", 3);
    expect_shapes(file, root, counts.size() == 2 * names.size());
  }
  std::size_t next_point = 0, next_triangle = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    GeometryShape& shape = geometry.shapes.emplace_back();
    const std::size_t at = kShapeNumbers * k;
    shape.name = names[k];
    shape.kind = kinds[k];
    shape.on = side_in(file, root, geometry, &places[2 * k], vector_in(numbers, at));
    shape.q =
        Eigen::Quaterniond(numbers[at + 3], numbers[at + 4], numbers[at + 5], numbers[at + 6]);
    shape.axis = vector_in(numbers, at + 7);
    shape.radius = numbers[at + 10];
    shape.length = numbers[at + 11];
    shape.size = vector_in(numbers, at + 12);
    for (int n = 0; n < counts[2 * k]; ++n, ++next_point) {
      expect_shapes(file, root, 3 * next_point + 2 < points.size());
      shape.points.push_back(vector_in(points, 3 * next_point));
    }
    for (int n = 0; n < counts[2 * k + 1]; ++n, ++next_triangle) {
      expect_shapes(file, root, 3 * next_triangle + 2 < triangles.size());
      std::array<int, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = triangles[3 * next_triangle + c];
        expect_shapes(file, root, corners[c] >= 0 && corners[c] < counts[2 * k]);
      }
      shape.triangles.push_back(corners);
    }
  }
}

void write_cables(const Hdf5File& file, const Geometry& geometry) {
  if (geometry.cables.empty()) return;
  std::vector<std::string> names, kinds;
  std::vector<int> counts, places;
  std::vector<double> axes, numbers;
  for (const GeometryCable& cable : geometry.cables) {
    names.push_back(cable.name);
    kinds.push_back(cable.kind);
    counts.insert(counts.end(), {static_cast<int>(cable.sides.size()), cable.is_closed ? 1 : 0,
                                 cable.first_pulley});
    append(cable.axis, axes);
    for (std::size_t k = 0; k < cable.sides.size(); ++k) {
      places.insert(places.end(), {cable.sides[k].body, cable.sides[k].marker});
      append(cable.sides[k].position, numbers);
      numbers.push_back(cable.radii[k]);
    }
  }
  const std::string root = kCables;
  create_group(file, root);
  write_dataset(file, root + "/names", names);
  write_dataset(file, root + "/kinds", kinds);
  write_dataset(file, root + "/counts", {names.size(), 3}, counts);
  write_dataset(file, root + "/axes", {names.size(), 3}, axes);
  write_dataset(file, root + "/places", {places.size() / 2, 2}, places);
  write_dataset(file, root + "/numbers", {numbers.size() / 4, 4}, numbers);
}

void read_cables(const Hdf5File& file, Geometry& geometry) {
  const std::string root = kCables;
  if (!has_object(file, root)) return;
  const std::vector<std::string> names = read_string_dataset(file, root + "/names");
  const std::vector<std::string> kinds = read_string_dataset(file, root + "/kinds");
  const std::vector<int> counts = read_int_dataset(file, root + "/counts", 3);
  const std::vector<double> axes = read_double_dataset(file, root + "/axes", 3);
  const std::vector<int> places = read_int_dataset(file, root + "/places", 2);
  const std::vector<double> numbers = read_double_dataset(file, root + "/numbers", 4);
  expect_shapes(file, root,
                kinds.size() == names.size() && counts.size() == 3 * names.size() &&
                    axes.size() == 3 * names.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    GeometryCable& cable = geometry.cables.emplace_back();
    cable.name = names[k];
    cable.kind = kinds[k];
    cable.is_closed = counts[3 * k + 1] != 0;
    cable.first_pulley = counts[3 * k + 2];
    cable.axis = vector_in(axes, 3 * k);
    expect_shapes(
        file, root,
        counts[3 * k] >= 2 && cable.first_pulley >= 0 && cable.first_pulley < counts[3 * k]);
    for (int n = 0; n < counts[3 * k]; ++n, ++next) {
      expect_shapes(file, root, 2 * next + 1 < places.size() && 4 * next + 3 < numbers.size());
      cable.sides.push_back(
          side_in(file, root, geometry, &places[2 * next], vector_in(numbers, 4 * next)));
      cable.radii.push_back(numbers[4 * next + 3]);
    }
  }
}

}  // namespace buckens::run_store
