// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "buckens/linalg/solve_exchange.h"
#include "buckens/sweep/summary_table.h"
#include "buckens/sweep/table.h"
#include "buckens/sweep/variant_models.h"

namespace buckens::sweep {

/// The row of a variant.
struct VariantRow {
  SummaryCells cells;
  FileContents files;  ///< that the variant reads beyond those of the model without variants
};

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
  const std::string& source() const { return models_.source(); }
  /// Runs these variants side by side. Their number may change the last digits of large bodies.
  /// @return a row each; what fails is `failed` with its reason
  std::vector<VariantRow> run(const std::vector<Variant>& variants);
  /// Factors made so far.
  long num_factorisations() const { return exchange_.num_factorisations(); }
  /// Gives the kept factors back, before variants with other matrices.
  void forget_factors();

 private:
  struct Run;

  VariantRow run_one(const Variant& variant, Run& run);

  VariantModels models_;
  SweepTable table_;  // without variants
  linalg::SolveExchange exchange_;
  std::vector<std::unique_ptr<Run>> last_;
};

}  // namespace buckens::sweep
