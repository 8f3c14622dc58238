// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/variant_runs.h"

#include <algorithm>
#include <memory>
#include <new>
#include <optional>

#include <fmt/format.h>

#include "buckens/analysis/simulation/checkpoints.h"
#include "buckens/analysis/simulation/choose_modes.h"
#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/linalg/solve_exchange.h"
#include "buckens/run_store/basis_files.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/state_file.h"
#include "buckens/run_store/summary_json.h"

namespace buckens::sweep {

namespace {

namespace fs = std::filesystem;

/// Whether a directory holds the finished run of a model by this version.
bool holds_finished_run(const fs::path& directory, const model::ModelDescription& model) {
  std::error_code error;
  if (!fs::is_regular_file(directory / run_store::kSummaryName, error)) return false;
  const std::string summary = files::read_text_file(directory / run_store::kSummaryName);
  const bool is_wanted =
      run_store::is_summary_json(summary) &&
      run_store::status_in(summary, directory.string()) == run_store::RunStatus::finished &&
      fs::is_regular_file(directory / run_store::kModelName, error) &&
      files::read_text_file(directory / run_store::kModelName) == model.source;
  if (!is_wanted) return false;
  try {
    const run_store::RunReader run(directory);
    return run.version() == kVersion && run.num_records() > 0;
  } catch (const IoError&) {  // damaged since: it is run again
    return false;
  }
}

/// What a run that was stopped left to go on from: the run of this model, by this version.
std::optional<base::SavedValues> checkpoint_in(const fs::path& directory,
                                               const model::ModelDescription& model) {
  std::error_code error;
  for (const char* name : {run_store::kCheckpointName, run_store::kModelName}) {
    if (!fs::is_regular_file(directory / name, error)) return {};
  }
  try {
    if (files::read_text_file(directory / run_store::kModelName) != model.source) return {};
    base::SavedValues state = run_store::read_state(directory / run_store::kCheckpointName);
    const auto version = state.texts.find("version");
    const bool is_ours =
        version != state.texts.end() && version->second == std::vector<std::string>{kVersion};
    if (is_ours) return state;
  } catch (const IoError&) {  // damaged: it begins anew
  }
  return {};
}

class Sweep {
 public:
  /// @throws what the model without variants throws: errors that do not concern the variants
  Sweep(const fs::path& model, const std::vector<std::string>& overrides, const SweepTable& table,
        const fs::path& out, const SweepOptions& options)
      : table_(table),
        out_(out),
        options_(options),
        shares_(table.variants.size(), 0.0),
        models_(model, overrides) {
    for (const Variant& variant : table.variants) {
      outcome_.variants.push_back({variant.name, VariantStatus::interrupted, {}, {}});
    }
  }

  SweepOutcome run() {
    make_directory();
    if (options_.on_begin) options_.on_begin();
    for (std::size_t begin = 0; begin < table_.variants.size() && !stopped_;) {
      begin = run_wave(begin);
    }
    outcome_.factorisations = exchange_.num_factorisations();
    outcome_.solves = exchange_.num_columns();
    outcome_.passes = exchange_.num_passes();
    return std::move(outcome_);
  }

 private:
  void make_directory() const {
    std::error_code error;
    fs::create_directories(out_, error);
    if (error) {
      throw IoError(fmt::format("{}: cannot create the directory of the sweep: {}.", out_.string(),
                                error.message()));
    }
  }

  /// Runs the next variants that are not there yet side by side.
  /// @return the first variant after them
  std::size_t run_wave(std::size_t begin) {
    std::vector<std::function<void()>> work;
    std::size_t next = begin;
    for (; next < table_.variants.size() &&
           work.size() < static_cast<std::size_t>(options_.together) && !stopped_;
         ++next) {
      std::shared_ptr<model::ModelDescription> description = read(next);
      if (!description) continue;
      work.emplace_back([this, next, description] { run_variant(next, std::move(*description)); });
    }
    exchange_.run(work);
    return next;
  }

  /// The model of a variant; none if that is all there is to do.
  std::shared_ptr<model::ModelDescription> read(std::size_t v) {
    try {
      VariantModels::Read read = models_.read(table_, table_.variants[v]);
      outcome_.variants[v].files = std::move(read.files);
      auto out = std::make_shared<model::ModelDescription>(std::move(read.description));
      if (!holds_finished_run(directory_of(v), *out)) return out;
      end(v, VariantStatus::kept);
    } catch (const std::exception& error) {
      end(v, VariantStatus::failed, reason_of(error));
    }
    return nullptr;
  }

  void run_variant(std::size_t v, model::ModelDescription description) {
    std::unique_ptr<run_store::RunDirectory> directory;
    results::RunSummary failure;
    try {
      auto checkpoint = checkpoint_in(directory_of(v), description);
      directory = directory_for(v, description, checkpoint);
      directory->log("variant " + table_.variants[v].name + " of a sweep");
      const auto built = build(std::move(description), *directory);
      analysis::SimulationOptions options;
      options.exchange = &exchange_;
      options.stop_reason = "interrupted by the user";
      options.on_progress = [&](const analysis::Progress& progress) { return go_on(v, progress); };
      const results::RunSummary summary =
          simulate(*built, *directory, options, std::move(checkpoint));
      return end(v, summary.finished ? VariantStatus::done : VariantStatus::interrupted);
    } catch (const std::exception& error) {
      failure.interrupted = reason_of(error);
    }
    if (directory) complete(*directory, failure);
    end(v, VariantStatus::failed, failure.interrupted);
  }

  /// @param checkpoint none in return if the results beside it cannot be read
  std::unique_ptr<run_store::RunDirectory> directory_for(
      std::size_t v, const model::ModelDescription& description,
      std::optional<base::SavedValues>& checkpoint) const {
    run_store::RunDirectoryOptions options{description.title, description.source, {}, false};
    if (checkpoint) {
      try {
        options.continues = run_store::continuation_from(*checkpoint);
        return std::make_unique<run_store::RunDirectory>(directory_of(v), options);
      } catch (const IoError&) {
        checkpoint.reset();
        options.continues.reset();
      }
    }
    return std::make_unique<run_store::RunDirectory>(directory_of(v), options);
  }

  static results::RunSummary simulate(const model::BuiltModel& built,
                                      run_store::RunDirectory& directory,
                                      const analysis::SimulationOptions& options,
                                      std::optional<base::SavedValues> checkpoint) {
    analysis::Simulation simulation(built, options);
    if (checkpoint) simulation.restore(*checkpoint);
    checkpoint.reset();  // closes its file
    std::optional<analysis::Checkpoints> checkpoints;
    if (const double interval = built.description.simulation->checkpoint; interval > 0.0) {
      checkpoints.emplace(simulation, interval, [&directory](const base::SavedValues& state) {
        directory.write_checkpoint(state);
      });
      directory.checkpoint_at_end([&simulation] { return simulation.save_to_write(); });
    }
    try {
      simulation.record_into(directory);
      return simulation.run();
    } catch (...) {
      directory.checkpoint_at_end({});
      throw;
    }
  }

  /// Modes chosen by trial are those of the variant; a basis in a file serves those it fits.
  std::unique_ptr<model::BuiltModel> build(model::ModelDescription description,
                                           run_store::RunDirectory& directory) {
    std::vector<std::string> notes;
    const fs::path files = description.directory;
    analysis::choose_modes(description, notes,
                           [&directory](const std::string& text) { directory.log(text); });
    run_store::BasisFiles bases(files, run_store::BasisFiles::Others::leave);
    auto built = model::build_model(std::move(description), &bases);
    built->model.notes.insert(built->model.notes.end(), notes.begin(), notes.end());
    return built;
  }

  /// Puts the reason into the directory of a run that failed, unless it is there already.
  static void complete(run_store::RunDirectory& directory, const results::RunSummary& failure) {
    try {
      directory.log("error: " + failure.interrupted);
      if (!directory.is_complete()) directory.finish(failure);
    } catch (const IoError&) {  // the reason of the failure says more
    }
  }

  bool go_on(std::size_t v, const analysis::Progress& progress) {
    shares_[v] = progress.duration > 0 ? progress.t / progress.duration : 0.0;
    return report(nullptr);
  }

  void end(std::size_t v, VariantStatus status, const std::string& message = {}) {
    outcome_.variants[v].status = status;
    outcome_.variants[v].message = message;
    if (status == VariantStatus::interrupted) return;
    shares_[v] = 1.0;
    ++num_ended_;
    report(&outcome_.variants[v]);
  }

  bool report(const VariantOutcome* ended) {
    if (!options_.on_progress) return true;
    double share = 0;
    for (const double s : shares_) share += s / static_cast<double>(shares_.size());
    if (!options_.on_progress({ended, num_ended_, table_.variants.size(), share})) stopped_ = true;
    return !stopped_;
  }

  fs::path directory_of(std::size_t v) const { return out_ / table_.variants[v].name; }

  const SweepTable& table_;
  const fs::path& out_;
  const SweepOptions& options_;
  std::vector<double> shares_;
  std::size_t num_ended_ = 0;
  bool stopped_ = false;
  linalg::SolveExchange exchange_;
  VariantModels models_;
  SweepOutcome outcome_;
};

}  // namespace

std::string to_string(VariantStatus status) {
  switch (status) {
    case VariantStatus::done:
      return "done";
    case VariantStatus::kept:
      return "kept";
    case VariantStatus::failed:
      return "failed";
    case VariantStatus::interrupted:
      break;
  }
  return "interrupted";
}

std::string reason_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) == nullptr) return error.what();
  return "there is not enough memory for this variant beside those that run with it; run fewer "
         "together, use fewer elements, or a machine with more memory";
}

SweepOutcome run_variants(const fs::path& model, const std::vector<std::string>& overrides,
                          const SweepTable& table, const fs::path& out,
                          const SweepOptions& options) {
  return Sweep(model, overrides, table, out, options).run();
}

}  // namespace buckens::sweep
