// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "buckens/page/view_page.h"

namespace buckens::page {

/// One run in the page (PageRun in viewer/src/page_data.ts).
/// @param options max_bytes applies to this run alone
/// @throws IoError if the directory holds no run, or one without records
nlohmann::ordered_json page_run(const std::filesystem::path& directory,
                                const ViewPageOptions& options, ViewPageReport& report);

}  // namespace buckens::page
