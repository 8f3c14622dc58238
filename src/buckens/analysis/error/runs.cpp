// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/runs.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "buckens/analysis/error/estimate.h"
#include "buckens/base/allowed_threads.h"

namespace buckens::analysis {

namespace {

// With step control: fewer additional steps than this do not show an order.
constexpr double kLeastRefinement = 1.2;
// Of the largest value of a sensor.
constexpr double kDoubtful = 0.1;

const char* remedy_for(const std::string& source) {
  if (source == results::kTimeStepSource) return "use a shorter step, or a smaller tolerance";
  if (source == "frames") return "give the beams more frames (`frames: 8`)";
  if (source == "coupling") return "use `coupling: full`";
  if (source == "modes") return "keep more modes, or the full mesh";
  return "use a finer mesh";
}

/// Simulates a variant; none where it was interrupted.
std::unique_ptr<SensorCurves> run_variant(const ErrorVariant& variant,
                                          const ErrorRunOptions& options) {
  auto out = std::make_unique<SensorCurves>();
  const auto built = [&] {
    const base::AllowedThreads threads(options.threads);
    return model::build_model(variant.description);
  }();
  SimulationOptions simulation;
  simulation.tells_warnings = false;  // those of the run itself have been told
  simulation.threads = options.threads;
  simulation.on_progress = options.on_progress;
  simulate(*built, *out, simulation);
  return out->summary() && out->summary()->finished ? std::move(out) : nullptr;
}

/// Fills in what only the run shows. @return false if it shows nothing
bool complete(results::ErrorSource& source, const results::RunSummary& own,
              const results::RunSummary& further) {
  source.steps = further.steps;
  source.seconds = further.wall_seconds.total;
  if (source.factor > 0) return true;
  source.refinement = static_cast<double>(further.steps) / static_cast<double>(own.steps);
  if (source.refinement < kLeastRefinement) return false;
  source.factor = two_grid_factor(source.refinement);
  return true;
}

}  // namespace

results::ErrorStatement state_errors(const ErrorVariants& variants, const SensorCurves& run,
                                     const ErrorRunOptions& options) {
  ErrorEstimate estimate(run);
  for (const std::string& note : variants.notes) estimate.note(note);
  for (std::size_t k = 0; k < variants.variants.size(); ++k) {
    const ErrorVariant& variant = variants.variants[k];
    if (options.on_begin) options.on_begin(variant.source, k, variants.variants.size());
    try {
      const auto further = run_variant(variant, options);
      if (!further) {
        estimate.set_incomplete();
        break;
      }
      results::ErrorSource source = variant.source;
      if (complete(source, *run.summary(), *further->summary())) {
        estimate.add(std::move(source), *further);
      } else {
        estimate.note(fmt::format("{}: not assessed, {} takes {} steps instead of {}",
                                  variant.source.name, variant.source.what,
                                  further->summary()->steps, run.summary()->steps));
      }
    } catch (const std::exception& error) {
      estimate.note(fmt::format("{}: not assessed, the run with {} failed: {}", variant.source.name,
                                variant.source.what, error.what()));
    }
  }
  return estimate.statement();
}

std::vector<std::string> doubts(const results::ErrorStatement& statement) {
  std::vector<std::string> out;
  const results::SensorErrors* worst = nullptr;
  double most = kDoubtful;
  std::string unresolved;
  for (const results::SensorErrors& sensor : statement.sensors) {
    // Energies contain the balance, which is only error.
    if (sensor.unit == "J") continue;
    if (!sensor.is_resolved) unresolved += (unresolved.empty() ? "" : ", ") + sensor.name;
    if (sensor.peak.uncertainty <= most * sensor.scale) continue;
    most = sensor.peak.uncertainty / sensor.scale;
    worst = &sensor;
  }
  if (!unresolved.empty()) {
    out.push_back(
        fmt::format("halving the step changes the curves of {} completely: the motion is chaotic "
                    "or the step is too long; shorten the step, or rely on means and extremes only",
                    unresolved));
  }
  if (worst != nullptr && !worst->peak.parts.empty()) {
    const auto part = std::max_element(worst->peak.parts.begin(), worst->peak.parts.end());
    const auto& source =
        statement.sources[static_cast<std::size_t>(part - worst->peak.parts.begin())];
    out.push_back(
        fmt::format("the error statement gives {:.2g} % for the peak of {}, mostly due to {}; {}",
                    100.0 * most, worst->name, source.name, remedy_for(source.name)));
  }
  return out;
}

}  // namespace buckens::analysis
