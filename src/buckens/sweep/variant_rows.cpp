// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/variant_rows.h"

#include <functional>
#include <utility>

#include "buckens/analysis/simulation/choose_modes.h"
#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/run_store/basis_files.h"
#include "buckens/sweep/summary.h"

namespace buckens::sweep {

/// In the order of destruction: the simulation uses the others.
struct VariantRows::Run {
  SensorExtremes extremes;
  std::unique_ptr<model::BuiltModel> built;
  std::unique_ptr<analysis::Simulation> simulation;
};

VariantRows::VariantRows(std::filesystem::path model, std::vector<std::string> overrides,
                         std::vector<std::string> paths)
    : models_(std::move(model), std::move(overrides)), table_{std::move(paths), {}} {}

VariantRows::~VariantRows() = default;

void VariantRows::forget_factors() { last_.clear(); }

std::vector<VariantRow> VariantRows::run(const std::vector<Variant>& variants) {
  std::vector<VariantRow> rows(variants.size());
  std::vector<std::unique_ptr<Run>> runs;
  std::vector<std::function<void()>> work;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    runs.push_back(std::make_unique<Run>());
    work.emplace_back([&, v] { rows[v] = run_one(variants[v], *runs[v]); });
  }
  if (work.size() == 1) {
    work.front()();
  } else {
    exchange_.run(work);
  }
  last_ = std::move(runs);
  return rows;
}

VariantRow VariantRows::run_one(const Variant& variant, Run& run) {
  VariantOutcome outcome{variant.name, VariantStatus::done, {}, {}};
  VariantRow row;
  try {
    VariantModels::Read read = models_.read(table_, variant);
    row.files = std::move(read.files);
    std::vector<std::string> notes;
    run_store::BasisFiles bases(read.description.directory, run_store::BasisFiles::Others::leave);
    analysis::choose_modes(read.description, notes);
    run.built = model::build_model(std::move(read.description), &bases);
    run.built->model.notes.insert(run.built->model.notes.end(), notes.begin(), notes.end());
    analysis::SimulationOptions options;
    options.exchange = &exchange_;
    options.tells_warnings = false;
    run.simulation = std::make_unique<analysis::Simulation>(*run.built, options);
    run.simulation->record_into(run.extremes);
    const results::RunSummary summary = run.simulation->run();
    row.cells = summary_cells(table_, variant, outcome);
    for (auto& cell : run.extremes.cells(summary)) row.cells.push_back(std::move(cell));
    return row;
  } catch (const std::exception& error) {
    outcome.status = VariantStatus::failed;
    outcome.message = reason_of(error);
  }
  row.cells = summary_cells(table_, variant, outcome);
  return row;
}

}  // namespace buckens::sweep
