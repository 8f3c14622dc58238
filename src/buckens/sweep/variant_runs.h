// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "buckens/sweep/table.h"
#include "buckens/sweep/variant_models.h"

namespace buckens::sweep {

/// Said of a model that cannot be simulated.
inline constexpr char kNoSimulation[] =
    "there is no `simulation:`, so the duration is unknown. Add, for instance, `simulation: "
    "{duration: 1 s, step: 1 ms}`.";

/// How the run of a variant ended.
enum class VariantStatus {
  done,         ///< in this sweep
  kept,         ///< by an earlier sweep into the same directory, with the same model and values
  failed,       ///< the message says why; what was recorded is kept
  interrupted,  ///< or not begun
};

std::string to_string(VariantStatus status);

/// Why a variant failed, for its row.
std::string reason_of(const std::exception& error);

struct VariantOutcome {
  std::string name;
  VariantStatus status = VariantStatus::interrupted;
  std::string message;  ///< why it failed
  FileContents files;   ///< that it read beyond those of the model without variants
};

struct SweepProgress {
  const VariantOutcome* ended = nullptr;  ///< a variant that just ended
  std::size_t num_ended = 0, num_variants = 0;
  double share = 0;  ///< of all steps, approximately
};

struct SweepOptions {
  int together = 6;  ///< variants that advance together and share solves
  /// Called when the directory of the sweep is there, before the first variant.
  std::function<void()> on_begin;
  /// Called when variants end and after steps; returning false ends the sweep after these steps.
  std::function<bool(const SweepProgress&)> on_progress;
};

struct SweepOutcome {
  std::vector<VariantOutcome> variants;  ///< in the order of the table
  long factorisations = 0;               ///< of large bodies, all variants together
  long solves = 0;                       ///< columns of large solves
  long passes = 0;                       ///< times that a factor was read for them
};

/// Runs the variants of a model, each into its own run directory, `out`/NAME.
///
/// Those that share a body's matrices share its factor, and their solves go together, see
/// linalg::SolveExchange. Variants finished by an earlier sweep are kept if the model file, the
/// files it names and their values are unchanged. A variant that fails does not stop the
/// others.
/// @param overrides apply to all variants, before their own values
/// @throws IoError if `out` cannot be created; whatever reading the model without variants throws
SweepOutcome run_variants(const std::filesystem::path& model,
                          const std::vector<std::string>& overrides, const SweepTable& table,
                          const std::filesystem::path& out, const SweepOptions& options);

}  // namespace buckens::sweep
