// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace buckens::page {

/// Distinguishing names of run directories: the last part, or as many as needed. One name each.
std::vector<std::string> directory_names(const std::vector<std::filesystem::path>& directories);

/// What --set changed in the model of a run, as typed; empty if the run has no model.
std::vector<std::string> run_changes(const std::filesystem::path& directory);

}  // namespace buckens::page
