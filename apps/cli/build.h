// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/model/model_builder.h"

namespace buckens::cli {

/// Builds the model of a model file: chooses modes where `reduction: auto` asks for it, and keeps
/// reduced bases in the files that the model names.
std::unique_ptr<model::BuiltModel> build(model::ModelDescription description);
/// The same for a model file with changes.
std::unique_ptr<model::BuiltModel> read_and_build(const std::string& model,
                                                  const std::vector<std::string>& overrides);

}  // namespace buckens::cli
