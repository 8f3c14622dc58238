// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/sweep/status.h"

namespace buckens::cli {

/// What `buckens sweep --status OUT` prints: a line in all, one per shard where there are several.
std::string status_text(const sweep::SweepStatus& status);

/// The same for programs.
std::string status_json(const sweep::SweepStatus& status);

}  // namespace buckens::cli
