// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/stored_size.h"

#include <algorithm>
#include <cmath>

namespace buckens::results {

namespace {

constexpr std::size_t kChunkBytes = 65536;
constexpr std::size_t kMostChunkRows = 256;
// Headers, attributes, index and names of a data set, with its share of /geometry:
// 1.4 to 1.7 kB in the files of the examples.
constexpr double kBooks = 1500;

double table_bytes(std::size_t values, double rows, std::size_t value_size) {
  const auto chunk = static_cast<double>(chunk_rows(values));
  const double stored_rows = chunk * std::ceil(rows / chunk);
  return kBooks + stored_rows * static_cast<double>(values * value_size);
}

}  // namespace

std::size_t chunk_rows(std::size_t values_per_row) {
  return std::clamp<std::size_t>(kChunkBytes / (sizeof(double) * values_per_row), 1,
                                 kMostChunkRows);
}

double stored_bytes(const RecordLayout& layout, double rows, std::size_t value_size) {
  if (layout.channels().empty()) return 0;
  double sum = table_bytes(1, rows, sizeof(double));  // the instants
  for (const Channel& channel : layout.channels()) {
    sum += table_bytes(channel.size(), rows, value_size);
  }
  return sum;
}

double stored_bytes(const RecordLayout& layout) {
  double sum = 0;
  for (const Channel& channel : layout.channels()) {
    sum += kBooks + static_cast<double>(channel.size() * sizeof(double));
  }
  return sum;
}

double stored_bytes(const Geometry& geometry) {
  double sum = 0;
  const auto add = [&sum](std::size_t count, std::size_t size) {
    sum += static_cast<double>(count * size);
  };
  for (const GeometryBody& body : geometry.bodies) {
    add(static_cast<std::size_t>(body.nodes.size()), sizeof(double));
    add(body.elements.size(), 2 * sizeof(int));
    add(body.radius.size(), 2 * sizeof(double));
    add(body.faces.size() + body.face_places.size(), 4 * sizeof(int));
    add(body.face_elements.size() + body.cell_kinds.size() + body.cell_nodes.size() +
            body.cell_places.size() + body.field_nodes.size() + body.field_elements.size(),
        sizeof(int));
  }
  for (const GeometryLoad& load : geometry.loads) {
    add(load.positions.size() + load.directions.size(), 3 * sizeof(double));
  }
  for (const GeometryShape& shape : geometry.shapes) {
    add(15 + 3 * shape.points.size(), sizeof(double));
    add(4 + 3 * shape.triangles.size(), sizeof(int));
  }
  return sum;
}

}  // namespace buckens::results
