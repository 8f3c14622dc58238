// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/results/record_sink.h"

namespace buckens::analysis {

/// One component of a sensor over a run.
struct SensorCurve {
  std::string name;  ///< "tip.x", "gap"
  std::string unit;
  std::vector<double> values;  ///< one per record
};

/// Keeps the sensors of a run in memory, and passes on everything except the end.
class SensorCurves : public results::RecordSink {
 public:
  /// @param next receives everything except finish(); may be null
  /// @param watched bodies whose largest deformation is kept
  explicit SensorCurves(results::RecordSink* next = nullptr, std::vector<std::string> watched = {})
      : next_(next), watched_(std::move(watched)) {}

  void begin(const results::RecordLayout& layout, const results::Geometry& geometry) override;
  void write(const results::Record& record) override;
  void finish(const results::RunSummary& summary) override { summary_ = summary; }
  void begin_fields(const results::FieldLayout& layout) override;
  void write_fields(const results::Record& fields) override;
  void write_extremes(const std::vector<double>& values) override;

  const std::vector<double>& times() const { return times_; }  ///< [s]
  const std::vector<SensorCurve>& curves() const { return curves_; }
  /// Null if there is none with this name.
  const SensorCurve* find(const std::string& name) const;
  /// Nodal displacements of a watched body at the record with the largest ones, one row per node;
  /// empty if none are recorded.
  linalg::Matrix largest_deformation(const std::string& body) const;
  /// Empty until the run is over.
  const std::optional<results::RunSummary>& summary() const { return summary_; }

 private:
  results::RecordSink* next_;
  std::vector<std::size_t> places_;  // of the curves in a record
  std::vector<double> times_;
  std::vector<SensorCurve> curves_;
  std::optional<results::RunSummary> summary_;

  struct Deformation {
    std::string body;
    std::size_t offset = 0, nodes = 0;  // in a record
    double size = 0;
    linalg::Matrix displacements;
  };
  std::vector<std::string> watched_;
  std::vector<Deformation> deformations_;
};

}  // namespace buckens::analysis
