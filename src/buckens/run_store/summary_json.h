// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "buckens/results/run_summary.h"

namespace buckens::run_store {

/// Status of a run, the entry "status" of summary.json.
///
/// `starting`: nothing recorded yet. `running`: records are being written, or the program was
/// killed. `finished`, `interrupted`: ended properly, with all figures.
enum class RunStatus { starting, running, finished, interrupted };

std::string to_string(RunStatus status);

/// summary.json of a run that has no figures yet.
/// @param started time of day the run began, see utc_now()
std::string status_json(RunStatus status, const std::string& title, const std::string& version,
                        const std::string& started);

/// summary.json of a run that ended. Numbers that are not finite become null.
std::string summary_json(const results::RunSummary& summary, const std::string& started,
                         const std::string& ended);

/// True if the text is the summary.json of a run of this program, with any status.
bool is_summary_json(std::string_view text);

/// Entry "status" of a summary.json. @throws IoError if there is none; `where` names the file
RunStatus status_in(std::string_view text, const std::string& where);

}  // namespace buckens::run_store
