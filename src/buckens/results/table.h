// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "buckens/results/record_sink.h"

namespace buckens::results {

/// All records of a run in memory.
class Table : public RecordSink {
 public:
  void begin(const RecordLayout& layout, const Geometry& geometry) override;
  void write(const Record& record) override;
  void finish(const RunSummary& summary) override;
  void begin_fields(const FieldLayout& layout) override;
  void write_fields(const Record& fields) override;
  void write_extremes(const std::vector<double>& values) override { extremes_ = values; }

  const RecordLayout& layout() const { return layout_; }
  const Geometry& geometry() const { return geometry_; }
  /// Empty until the run is over.
  const std::optional<RunSummary>& summary() const { return summary_; }

  std::size_t num_records() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }  ///< [s]
  /// All values of one channel: a row per record, the channel's values in row-major order.
  /// @throws ModelError if nothing is recorded under this path
  Eigen::MatrixXd values(std::string_view path) const;

  const std::vector<double>& field_times() const { return field_times_; }  ///< [s]
  /// All values of one field, as values(). @throws ModelError if there is none under this path
  Eigen::MatrixXd field_values(std::string_view path) const;
  /// Largest values of the run. @throws ModelError if there are none under this path
  Eigen::VectorXd extremes(std::string_view path) const;

 private:
  RecordLayout layout_;
  Geometry geometry_;
  std::optional<RunSummary> summary_;
  std::vector<double> times_;
  std::vector<double> values_;  // record after record
  FieldLayout field_layout_;
  std::vector<double> field_times_, field_values_, extremes_;
};

}  // namespace buckens::results
