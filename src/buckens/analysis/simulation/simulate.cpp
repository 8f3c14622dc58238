// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/simulate.h"

namespace buckens::analysis {

results::RunSummary simulate(const model::BuiltModel& built, results::RecordSink& sink,
                             const SimulationOptions& options) {
  Simulation simulation(built, options);
  simulation.record_into(sink);
  return simulation.run();
}

}  // namespace buckens::analysis
