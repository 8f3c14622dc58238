// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::run_store::test {

inline constexpr char kMises[] = "fields/bodies/rod/nodes/von_mises";
inline constexpr char kStress[] = "fields/bodies/rod/elements/stress";
inline constexpr char kLargest[] = "extremes/bodies/rod/nodes/von_mises";

/// The sample with one tetrahedron on the rod, whose fields have four places on three nodes.
inline results::Geometry fields_geometry() {
  results::Geometry out = sample_geometry();
  results::GeometryBody& rod = out.bodies[1];
  rod.kind = results::BodyKind::solid;
  rod.nodes.resize(4, 3);
  rod.nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  rod.faces = {{0, 2, 1, -1}, {0, 1, 3, -1}};
  rod.face_elements = {0, 0};
  rod.cell_kinds = {fem::CellKind::tet4};
  rod.cell_nodes = {0, 1, 2, 3};
  rod.field_nodes = {0, 1, 1, 3};
  rod.field_elements = {0};
  rod.face_places = {{0, -1, 2, -1}, {0, 2, 3, -1}};
  rod.cell_places = {0, 2, -1, 3};
  return out;
}

inline results::FieldLayout sample_fields() {
  results::FieldLayout out;
  out.fields.add({kMises, "Pa", {4}, "equivalent stress", {}});
  out.fields.add({kStress, "Pa", {1, 6}, "body axes", {"xx", "yy", "zz", "xy", "yz", "zx"}});
  out.extremes.add({kLargest, "Pa", {4}, "largest over the run so far", {}});
  out.extremes.add({std::string(kLargest) + "_time", "s", {4}, "when it was largest", {}});
  return out;
}

inline results::Record field_record(double t) {
  results::Record out{t, {1 + t, 2 + t, std::nan(""), 4 + t}};
  for (int k = 0; k < 6; ++k) out.values.push_back(10 * k + t);
  return out;
}

/// @param records written; fields with every third
inline void write_fields_run(const std::filesystem::path& path, std::size_t records,
                             bool finish = true) {
  RunDirectory run(path, {.title = "sample", .model_text = "buckens: 1\n", .flush = {}});
  const results::RecordLayout layout = sample_layout(4);
  run.begin_fields(sample_fields());
  run.begin(layout, fields_geometry());
  for (std::size_t i = 0; i < records; ++i) {
    const results::Record record = sample_record(i, layout.num_values());
    run.write(record);
    if (i % 3 == 0) run.write_fields(field_record(record.t));
  }
  run.write_extremes({5, 6, 7, 8, 0.1, 0.2, 0.3, 0.4});
  if (finish) run.finish(finished_summary());
}

}  // namespace buckens::run_store::test
