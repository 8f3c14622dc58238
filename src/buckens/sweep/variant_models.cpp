// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/variant_models.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/model_file/model_file.h"
#include "buckens/sweep/variant_runs.h"

namespace buckens::sweep {

VariantModels::VariantModels(std::filesystem::path model, std::vector<std::string> overrides)
    : model_(std::move(model)),
      overrides_(std::move(overrides)),
      text_(files::read_text_file(model_, "model file")) {
  const files::FilesRead files;
  const model::ModelDescription base =
      model_file::read_model_text(text_, model_.string(), overrides_, step_meshes_);
  if (!base.simulation) throw InputError(base.where, kNoSimulation);
  source_ = base.source;
  own_ = known_ = files.hashes();
}

VariantModels::Read VariantModels::read(const SweepTable& table, const Variant& variant) {
  std::vector<std::string> overrides = overrides_;
  for (std::string& text : table.overrides(variant)) overrides.push_back(std::move(text));
  const files::FilesRead files;
  Read out{model_file::read_model_text(text_, model_.string(), overrides, step_meshes_), {}};
  require_unchanged(files.hashes());
  for (const auto& [path, content] : files.hashes()) {
    known_.emplace(path, content);
    if (!own_.contains(path)) out.files.emplace(path, content);
  }
  return out;
}

void VariantModels::require_unchanged(const FileContents& files) const {
  for (const auto& [path, content] : files) {
    const auto known = known_.find(path);
    if (known == known_.end() || known->second == content) continue;
    throw InputError({path.string(), 0, 0},
                     "the file has changed since the sweep began, whose variants would be of "
                     "different models; repeat the sweep, which runs again what the change "
                     "concerns");
  }
}

}  // namespace buckens::sweep
