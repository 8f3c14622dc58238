// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"
#include "buckens/model_file/step_mesh_cache.h"
#include "buckens/sweep/table.h"

namespace buckens::sweep {

/// Files by their paths, with hashes of their contents.
using FileContents = std::map<std::filesystem::path, std::uint64_t>;

/// The models of the variants of a sweep. The model file is read once, and a file that it or a
/// variant names may not change afterwards: a sweep that takes hours would otherwise end with a
/// table of rows of different models.
class VariantModels {
 public:
  /// @throws what reading the model without variants throws; InputError without a `simulation:`
  VariantModels(std::filesystem::path model, std::vector<std::string> overrides);

  /// The model without variants as text, with hashes of the files that it names.
  const std::string& source() const { return source_; }

  struct Read {
    model::ModelDescription description;
    FileContents files;  ///< that the model without variants does not read
  };
  /// @throws what reading a model throws; InputError naming a file that has changed
  Read read(const SweepTable& table, const Variant& variant);

 private:
  void require_unchanged(const FileContents& files) const;

  std::filesystem::path model_;
  std::vector<std::string> overrides_;
  std::string text_, source_;
  model_file::StepMeshCache step_meshes_;
  FileContents own_;    // of the model without variants
  FileContents known_;  // of variants, too
};

}  // namespace buckens::sweep
