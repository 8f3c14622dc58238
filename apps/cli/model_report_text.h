// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/analysis/simulation/model_report.h"

namespace buckens::cli {

/// Output of `buckens check`, for people.
std::string report_text(const std::string& title, const analysis::ModelReport& report);

/// The same as a JSON object; SI units, described in docs/reference/command-line.md.
std::string report_json(const std::string& title, const analysis::ModelReport& report);

}  // namespace buckens::cli
