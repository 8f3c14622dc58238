// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/test/described.h"
#include "buckens/results/recorder.h"

namespace buckens::results::test {

/// A model with a recorder and a state to be set by hand.
struct Recorded {
  std::unique_ptr<model::BuiltModel> built;
  dynamics::MassMetric metric;
  Recorder recorder;
  model::State state;
  Record last;

  explicit Recorded(const model::test::Described& model)
      : built(model.build()),
        metric(built->model),
        recorder(*built, metric, false),
        state(model::placed_state(built->model)) {}

  model::BodyState& body(std::size_t b = 0) { return state.bodies[b]; }

  void record(const WorkBalance& work = {}) { last = recorder.record(state, work); }

  /// Values of a channel in the last record.
  Eigen::VectorXd values(const std::string& path) const {
    const int index = recorder.layout().find(path);
    if (index < 0) throw std::out_of_range(path);
    const auto k = static_cast<std::size_t>(index);
    return Eigen::Map<const Eigen::VectorXd>(
        last.values.data() + recorder.layout().offset(k),
        static_cast<Eigen::Index>(recorder.layout().channel(k).size()));
  }
  Eigen::VectorXd sensor(const std::string& name) const { return values("sensors/" + name); }
};

}  // namespace buckens::results::test
