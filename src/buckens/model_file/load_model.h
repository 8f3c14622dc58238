// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::model_file {

/// Reads a model file and builds its mechanism.
/// @param overrides "bodies.rod.beam.elements=32", as `--set`
/// @throws InputError, ModelError citing file:line:column; IoError
std::unique_ptr<model::BuiltModel> load_model(const std::filesystem::path& path,
                                              const std::vector<std::string>& overrides = {});

}  // namespace buckens::model_file
