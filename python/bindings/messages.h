// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/base/log.h"

namespace buckens::python {

/// Messages of the library, kept until Python fetches them.
///
/// The library logs under a lock, from threads that may not hold Python's: handing a message over
/// at once could make each wait for the other.
void collect_messages();

/// What was said since the last call.
std::vector<std::pair<base::LogLevel, std::string>> take_messages();

}  // namespace buckens::python
