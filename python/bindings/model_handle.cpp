// SPDX-License-Identifier: Apache-2.0
#include "bindings/model_handle.h"

#include <utility>

#include "buckens/analysis/simulation/choose_modes.h"
#include "buckens/base/log.h"
#include "buckens/model_file/model_file.h"
#include "buckens/run_store/basis_files.h"

namespace buckens::python {

namespace {

std::unique_ptr<model::BuiltModel> build(model::ModelDescription description) {
  std::vector<std::string> notes;
  analysis::choose_modes(description, notes,
                         [](const std::string& text) { base::log(base::LogLevel::info, text); });
  run_store::BasisFiles bases(description.directory);
  std::unique_ptr<model::BuiltModel> out = model::build_model(std::move(description), &bases);
  out->model.notes.insert(out->model.notes.end(), notes.begin(), notes.end());
  return out;
}

}  // namespace

ModelHandle::ModelHandle(model::ModelDescription description, std::string unseen)
    : description_(std::move(description)), unseen_(std::move(unseen)) {}

std::shared_ptr<ModelHandle> ModelHandle::read(const std::string& path,
                                               const std::vector<std::string>& overrides) {
  return std::make_shared<ModelHandle>(model_file::read_model_file(path, overrides), "");
}

std::shared_ptr<ModelHandle> ModelHandle::parse(const std::string& text, const std::string& name,
                                                const std::vector<std::string>& overrides,
                                                bool is_generated) {
  const std::string unseen = is_generated ? name : "";
  const auto read_text = [&] { return model_file::read_model_text(text, name, overrides); };
  return std::make_shared<ModelHandle>(without_places(unseen, read_text), unseen);
}

std::shared_ptr<const model::BuiltModel> ModelHandle::built() const {
  const std::lock_guard lock(mutex_);
  if (!built_) built_ = build(description_);
  return built_;
}

std::shared_ptr<const model::BuiltModel> ModelHandle::built_with(
    std::vector<model::OwnForce> forces, const std::vector<model::SignalFunction>& signals) const {
  if (forces.empty() && signals.empty()) return built();
  model::ModelDescription description = description_;
  for (model::OwnForce& force : forces) description.own_forces.push_back(std::move(force));
  std::unique_ptr<model::BuiltModel> out = build(std::move(description));
  model::give_functions(signals, *out);
  return out;
}

}  // namespace buckens::python
