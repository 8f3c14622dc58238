// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Core>

namespace buckens::analysis {

class Simulation;

/// What a callback can see and do after an accepted step.
class StepView {
 public:
  StepView(Simulation& simulation, double step) : simulation_(&simulation), step_(step) {}

  double time() const;                   ///< end of the step [s]
  double step() const { return step_; }  ///< its length [s]
  const Simulation& simulation() const { return *simulation_; }

  /// Ends the run after this step.
  void stop() const;
  /// As Simulation::set_load, from this instant on.
  void set_load(const std::string& load, const Eigen::Vector3d& value) const;
  /// As Simulation::set_signal, from this instant on.
  void set_signal(const std::string& signal, double value) const;
  /// As Simulation::sensor.
  Eigen::Map<const Eigen::VectorXd> sensor(const std::string& name) const;

 private:
  Simulation* simulation_;
  double step_;
};

}  // namespace buckens::analysis
