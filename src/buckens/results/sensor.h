// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/channel.h"
#include "buckens/results/observation.h"

namespace buckens::results {

/// A sensor of the model file; may fill more than one channel.
class Sensor {
 public:
  virtual ~Sensor() = default;

  /// Channels in the order in which append() gives their values.
  virtual std::vector<Channel> channels() const = 0;
  /// Called once at t = 0, before the first append().
  virtual void start(const Observation& /*now*/) {}
  /// What append() reads of an observation besides motions, forces of joints and work.
  virtual ObservedParts reads() const { return {}; }
  /// Appends the values of all channels.
  virtual void append(const Observation& now, std::vector<double>& values) = 0;
  /// Saves or restores what later values depend on: the reference of sensors.
  virtual void visit_saved(const base::SaveVisit& /*visit*/) {}
};

/// Makes the sensor of a spec.
/// @throws InputError if it names an unknown joint, ModelError if it is meaningless there
std::unique_ptr<Sensor> make_sensor(const model::BuiltModel& built, std::size_t index);

}  // namespace buckens::results
