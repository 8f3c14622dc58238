// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/results/channel.h"
#include "buckens/results/field_layout.h"
#include "buckens/results/geometry.h"
#include "buckens/results/run_summary.h"

namespace buckens::results {

/// The values of all channels at one instant.
struct Record {
  double t = 0;                ///< [s]
  std::vector<double> values;  ///< RecordLayout::num_values() numbers
};

/// Destination of the records of a run: a directory, memory, a test.
///
/// Called in the order begin, write …, finish; `finish` also after a run that failed, with
/// RunSummary::finished false. Runs with fields over meshes call begin_fields before begin, and
/// write_fields and write_extremes between the others; a sink may ignore fields.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  RecordSink() = default;
  RecordSink(const RecordSink&) = delete;
  RecordSink& operator=(const RecordSink&) = delete;

  virtual void begin(const RecordLayout& layout, const Geometry& geometry) = 0;
  /// @pre record.t is larger than that of the record before
  virtual void write(const Record& record) = 0;
  virtual void finish(const RunSummary& summary) = 0;

  virtual void begin_fields(const FieldLayout& /*layout*/) {}
  /// @param fields values of FieldLayout::fields at the instant of a record that was written before
  virtual void write_fields(const Record& /*fields*/) {}
  /// The largest values so far. @param values of FieldLayout::extremes
  virtual void write_extremes(const std::vector<double>& /*values*/) {}
};

}  // namespace buckens::results
