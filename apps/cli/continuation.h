// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "buckens/model/spec/model_description.h"
#include "buckens/run_store/kept_records.h"

namespace buckens::cli {

/// The user's options for going on with a run.
struct ContinuationArguments {
  std::string directory;             ///< empty: the run begins anew
  std::optional<std::string> until;  ///< another end: a time such as 0.2 or 30ms
};

void add_continuation_options(CLI::App& verb, ContinuationArguments& arguments);

/// A run directory whose run goes on.
class Continuation {
 public:
  /// @throws IoError if the directory holds no run, or no sound checkpoint, InputError if the run
  /// depends on a program that steers it
  explicit Continuation(std::filesystem::path directory);

  /// The model that was run, with everything that --set had changed.
  std::filesystem::path model() const;
  std::filesystem::path checkpoint() const;
  const run_store::Continuation& kept() const { return kept_; }

  /// Changes of the model that move its end and keep steps and times of records as they are.
  /// @param until a time as in a model file
  /// @throws InputError if it is no time, or the run is beyond it
  std::vector<std::string> changes_until(const model::ModelDescription& description,
                                         const std::string& until) const;

 private:
  std::filesystem::path directory_;
  run_store::Continuation kept_;
};

}  // namespace buckens::cli
