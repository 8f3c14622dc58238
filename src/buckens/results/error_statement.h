// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::results {

/// Name of the source of errors revealed by a shorter step.
inline constexpr const char* kTimeStepSource = "time step";

/// What was changed in a further run to assess its effect.
struct ErrorSource {
  std::string name;       ///< "time step", "mesh", "frames", "coupling", "modes"
  std::string what;       ///< "step 0.5 ms in place of 1 ms"
  double refinement = 0;  ///< how many times finer; 0: the further run is exact in this respect
  double factor = 0;      ///< uncertainty over difference of the two runs
  long steps = 0;         ///< of the further run
  double seconds = 0;     ///< wall time of it
};

/// A number with its uncertainty.
struct UncertainValue {
  double value = 0;
  double at = 0;              ///< its time [s]
  double uncertainty = 0;     ///< sum of the parts and of iteration errors
  std::vector<double> parts;  ///< one per source
};

/// Uncertainty of one component of a sensor.
struct SensorErrors {
  std::string name;  ///< "tip.x"
  std::string unit;
  UncertainValue peak;   ///< the value of largest magnitude
  UncertainValue last;   ///< at the end of the run
  UncertainValue curve;  ///< over the whole run: where the runs differ most
  double range = 0;      ///< largest minus smallest value
  double sampling = 0;   ///< part of the peak's uncertainty: gaps between records
  double scale = 0;      ///< largest magnitude of all components of the sensor
  /// False if the runs differ as much as the curve itself varies: none of its digits is reliable.
  bool is_resolved = true;
};

/// Reliability of the sensors of a run, from further runs; theory: docs/theory/21-errors.md.
struct ErrorStatement {
  std::vector<ErrorSource> sources;
  std::vector<SensorErrors> sensors;
  std::vector<std::string> notes;  ///< what could not be assessed, and why
  bool is_complete = true;         ///< false: interrupted before all runs were made
};

}  // namespace buckens::results
