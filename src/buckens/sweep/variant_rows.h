// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "buckens/linalg/solve_exchange.h"
#include "buckens/model_file/step_mesh_cache.h"
#include "buckens/sweep/summary_table.h"
#include "buckens/sweep/table.h"

namespace buckens::sweep {

/// What a worker of a study does: runs variants of one model in memory and returns their rows of
/// the table, the same as run_variants() and sweep_summary() make by way of run directories.
///
/// The factors of the variants that ran last are kept: the next ones with the same matrices share
/// them.
class VariantRows {
 public:
  /// @param paths of the values of variants, as `--set` takes them
  /// @throws what reading the model without variants throws; InputError without a `simulation:`
  VariantRows(std::filesystem::path model, std::vector<std::string> overrides,
              std::vector<std::string> paths);
  ~VariantRows();

  /// The model without variants as text, with hashes of the files that it names.
  const std::string& source() const { return source_; }
  /// Runs these variants side by side. Their number may change the last digits of large bodies.
  /// @return a row each; what fails is `failed` with its reason
  std::vector<SummaryCells> run(const std::vector<Variant>& variants);
  /// Factors made so far.
  long num_factorisations() const { return exchange_.num_factorisations(); }
  /// Gives the kept factors back, before variants with other matrices.
  void forget_factors();

 private:
  struct Run;

  SummaryCells run_one(const Variant& variant, Run& run);

  std::filesystem::path model_;
  std::vector<std::string> overrides_;
  SweepTable table_;  // without variants
  std::string source_;
  model_file::StepMeshCache step_meshes_;
  linalg::SolveExchange exchange_;
  std::vector<std::unique_ptr<Run>> last_;
};

}  // namespace buckens::sweep
