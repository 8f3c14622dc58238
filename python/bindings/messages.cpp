// SPDX-License-Identifier: Apache-2.0
#include "bindings/messages.h"

#include <mutex>

namespace buckens::python {

namespace {

std::mutex mutex;
std::vector<std::pair<base::LogLevel, std::string>> messages;

}  // namespace

void collect_messages() {
  base::set_log_sink([](base::LogLevel level, const std::string& message) {
    const std::lock_guard lock(mutex);
    messages.emplace_back(level, message);
  });
}

std::vector<std::pair<base::LogLevel, std::string>> take_messages() {
  const std::lock_guard lock(mutex);
  return std::exchange(messages, {});
}

}  // namespace buckens::python
