// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/results/error_statement.h"

namespace buckens::cli {

/// Table of the peak of each sensor with its uncertainty and its sources, then notes.
std::string error_text(const results::ErrorStatement& errors);

}  // namespace buckens::cli
