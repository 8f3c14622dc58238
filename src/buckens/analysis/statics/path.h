// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "buckens/model/build/build_model.h"
#include "buckens/results/record_sink.h"

namespace buckens::analysis {

/// Progress of a static path.
struct StaticProgress {
  int point = 0;  ///< number of the point, the start is 1
  double load_factor = 0;
  double step = 0;     ///< length of the step to get here, in full steps
  int iterations = 0;  ///< of Newton, in that step
};

struct StaticPathOptions {
  /// Called after every point; returning false ends the path there.
  std::function<bool(const StaticProgress&)> on_progress;
  /// Why on_progress returned false, for the summary.
  std::string stop_reason = "stopped";
};

/// Traces equilibria over the load factor as requested by `static:` of the model file; by default
/// from 0 to 1 by arc length.
///
/// The start is the stable equilibrium at the first load factor to which the model, as placed,
/// descends. Then predictor along the path and Newton on the bordered system, with control of the
/// step length; limit points and bifurcations are located and reported. Records go to `sink`: their
/// time is the path's length in full steps, the load factor is the sensor `load-factor`. The
/// summary goes to the sink and is returned. Theory: docs/theory/12-static-paths.md.
///
/// A path that cannot be followed to its end stops there: the sink gets what was found and a
/// summary with `finished` false, then the error is rethrown.
/// @throws InputError if there is no load to scale or `stop` does not name a sensor, ModelError if
///         the start is a mechanism (naming the free direction) or has no equilibrium,
///         NumericalError naming the body or joint that resists, IoError from the sink
results::RunSummary trace_static_path(const model::BuiltModel& built, results::RecordSink& sink,
                                      const StaticPathOptions& options = {});

}  // namespace buckens::analysis
