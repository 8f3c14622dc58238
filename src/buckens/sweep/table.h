// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace buckens::sweep {

/// One variant of a model.
struct Variant {
  std::string name;                 ///< of its run directory
  std::vector<std::string> values;  ///< per path of the table, as written (YAML)
};

/// Variants of a model as a table of values over named quantities.
struct SweepTable {
  std::vector<std::string> paths;  ///< as `--set` takes them: "parameters.speed"
  std::vector<Variant> variants;

  /// The `--set` arguments for a variant: "PATH=VALUE" each.
  std::vector<std::string> overrides(const Variant& variant) const;
};

/// Reads a table in CSV: a first line of paths, then a line per variant. A column `name` names the
/// variants, otherwise they are numbered. Cells that contain commas are in double quotes (RFC
/// 4180); blank lines and lines that begin with # are left out.
/// @throws IoError if the file cannot be read
/// @throws InputError with file:line for rows of wrong length, repeated paths or names, names that
/// are not valid file names, a table without variants
SweepTable read_sweep_table(const std::filesystem::path& file);

/// All combinations of values, the last path varying fastest. Each text is "PATH=[VALUE, ...]".
/// @throws InputError naming a text that does not have this form, or for more than 1e5 variants
SweepTable combinations(const std::vector<std::string>& ranges);

}  // namespace buckens::sweep
