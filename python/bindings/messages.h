// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/base/log.h"

namespace buckens::python {

/// Messages of the library, stored until Python fetches them.
///
/// The library logs under a lock, from threads that may not hold Python's lock: passing a message
/// on at once could cause a deadlock.
void collect_messages();

/// Returns the messages since the last call.
std::vector<std::pair<base::LogLevel, std::string>> take_messages();

}  // namespace buckens::python
