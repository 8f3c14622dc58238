// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "buckens/model/build/build_model.h"

namespace buckens::cli {

/// The viewer's page without a run. It lies at the same place relative to the program in the build
/// and after installation.
/// @throws IoError if it is missing
std::filesystem::path find_page_template();

/// Writes a page that shows a model as it is assembled, before any step.
/// @param built gets a simulation if it has none: how to step is part of what is set up
/// @throws what a simulation throws while it is set up, IoError
void write_model_page(model::BuiltModel& built, const std::filesystem::path& page);

}  // namespace buckens::cli
