// SPDX-License-Identifier: Apache-2.0
#include "bindings/messages.h"

#include <mutex>
#include <utility>

namespace buckens::python {

namespace {

std::mutex message_mutex;
std::vector<std::pair<base::LogLevel, std::string>> kept_messages;

}  // namespace

void collect_messages() {
  base::set_log_sink([](base::LogLevel level, const std::string& message) {
    const std::lock_guard lock(message_mutex);
    kept_messages.emplace_back(level, message);
  });
}

std::vector<std::pair<base::LogLevel, std::string>> take_messages() {
  const std::lock_guard lock(message_mutex);
  return std::exchange(kept_messages, {});
}

}  // namespace buckens::python
