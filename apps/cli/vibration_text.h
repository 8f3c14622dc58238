// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/analysis/vibration/vibration.h"

namespace buckens::cli {

/// Vibrations as tables for people.
std::string vibration_text(const std::string& title,
                           const std::vector<analysis::VibrationReport>& reports);

/// The same and more for machines: `buckens modes --json`, and modes.json of a results directory.
std::string vibration_json(const std::string& title,
                           const std::vector<analysis::VibrationReport>& reports);

}  // namespace buckens::cli
