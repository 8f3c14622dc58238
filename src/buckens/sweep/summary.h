// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "buckens/results/record_sink.h"
#include "buckens/sweep/summary_table.h"
#include "buckens/sweep/table.h"
#include "buckens/sweep/variant_runs.h"

namespace buckens::sweep {

/// Names of the table in the directory of a sweep.
inline constexpr char kSweepName[] = "sweep.csv";
inline constexpr char kSweepHdf5Name[] = "sweep.h5";

/// Last value and extremes over time.
struct Extremes {
  double last = 0, least = 0, most = 0;
  bool is_empty = true;

  void see(double value) {
    last = value;
    least = is_empty ? value : std::min(least, value);
    most = is_empty ? value : std::max(most, value);
    is_empty = false;
  }
};

/// Watches the sensors of a run of which only the row in the table is wanted.
class SensorExtremes : public results::RecordSink {
 public:
  void begin(const results::RecordLayout& layout, const results::Geometry& geometry) override;
  void write(const results::Record& record) override;
  void finish(const results::RunSummary&) override {}

  /// Effort, trust and sensors, exactly as sweep_summary() finds them in a run directory.
  SummaryCells cells(const results::RunSummary& summary) const;

 private:
  struct Sensor {
    results::Channel channel;
    std::size_t offset;  // in a record
    std::vector<Extremes> extremes;
  };
  std::vector<Sensor> sensors_;
  long num_records_ = 0;
};

/// The first cells of a row: name, values, how it ended.
SummaryCells summary_cells(const SweepTable& table, const Variant& variant,
                           const VariantOutcome& outcome);

/// The table of a sweep: for each variant its values, how it ended, effort and trust, and for
/// every sensor the last value and the extremes over time.
/// @param out directory of the sweep; finished runs are read from there
SummaryTable sweep_summary(const std::filesystem::path& out, const SweepTable& table,
                           const SweepOutcome& outcome);

}  // namespace buckens::sweep
