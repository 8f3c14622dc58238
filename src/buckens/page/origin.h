// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace buckens::page {

/// Names that tell run directories apart: their last part, or as many as it takes. One name each.
std::vector<std::string> directory_names(const std::vector<std::filesystem::path>& directories);

/// What --set changed in the model of a run, as it was typed; empty where the run keeps no model.
std::vector<std::string> run_changes(const std::filesystem::path& directory);

}  // namespace buckens::page
