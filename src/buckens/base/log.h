// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace buckens::base {

enum class LogLevel { debug, info, warning, error };

/// Receives the library's messages; called under a lock, so it must not log itself.
using LogSink = std::function<void(LogLevel level, const std::string& message)>;

/// Sets where messages go, for the whole process; an empty sink (the default) drops them. The
/// library itself never prints. May be called from any thread.
void set_log_sink(LogSink sink);

void log(LogLevel level, const std::string& message);

}  // namespace buckens::base
