// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/analysis/statics/continuation.h"
#include "buckens/analysis/statics/friction_demand.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/field_recorder.h"
#include "buckens/results/record_sink.h"
#include "buckens/results/recorder.h"

namespace buckens::analysis {

/// Turns the points of a static path into records and a summary.
///
/// Before the channels of every run come the sensor `load-factor` and `static/unstable`. The time
/// stamp of a record is its position on the path.
class StaticPathRecord {
 public:
  /// @param time instant of laws of time [s]
  StaticPathRecord(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                   const RestRows& rest, const Compliances& compliances, double time,
                   results::RecordSink& sink);

  /// @throws InputError if `stop` does not name a sensor
  void begin(const PathPoint& start);
  void write(const PathPoint& at);
  /// Marks the last written point as critical.
  void add_critical_point(const PathPoint& at);
  /// Whether the sensor of `stop` has passed its value between the last two records.
  bool passed_stop() const { return passed_stop_; }
  /// Completes the summary and passes it to the sink.
  void finish(double load_factor);

  results::RunSummary summary;

 private:
  results::WorkBalance add_work(const PathPoint& at);
  void find_stop();
  void watch_stop(double value);
  void add_body(const model::WholeBody& whole);
  void watch_friction(const PathPoint& at);

  const model::BuiltModel& built_;
  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  const RestRows& rest_;
  const Compliances& compliances_;
  results::RecordSink& sink_;
  results::FieldRecorder fields_;
  model::State state_;
  std::unique_ptr<results::Recorder> recorder_;
  results::RecordLayout layout_;
  results::Record last_;
  bool has_last_ = false;
  std::optional<StaticPoint> before_;
  dynamics::Forces loads_before_;  // applied loads at factor one
  results::WorkBalance work_;
  double energy_scale_ = 0, largest_balance_ = 0;
  std::optional<std::size_t> stop_;  // index in the values of a record
  std::optional<double> stop_before_;
  bool passed_stop_ = false;
  std::vector<double> largest_rotation_;
  struct WorstFriction {
    FrictionDemand demand;
    double load_factor = 0;
  };
  std::map<std::string, WorstFriction> friction_;  // over the path, by what rubs
};

}  // namespace buckens::analysis
