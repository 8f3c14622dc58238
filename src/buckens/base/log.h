// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace buckens::base {

enum class LogLevel { debug, info, warning, error };

/// Receives the library's messages. It is called under a lock, so it must not log.
using LogSink = std::function<void(LogLevel level, const std::string& message)>;

/// Sets the receiver of messages for the whole process; an empty sink (the default) discards them.
/// The library itself never prints. May be called from any thread.
void set_log_sink(LogSink sink);

void log(LogLevel level, const std::string& message);

}  // namespace buckens::base
