// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::cli {

/// Builds the model of a model file: chooses modes for `reduction: auto`, and stores reduced bases
/// in the files named by the model. Probable faults of mesh files are listed in the notes of the
/// model.
/// @param meshes gets a line on each mesh of a file; null: the line goes to the log
std::unique_ptr<model::BuiltModel> build(model::ModelDescription description,
                                         std::vector<std::string>* meshes = nullptr);
/// The same for a model file with changes.
std::unique_ptr<model::BuiltModel> read_and_build(const std::string& model,
                                                  const std::vector<std::string>& overrides,
                                                  std::vector<std::string>* meshes = nullptr);

}  // namespace buckens::cli
