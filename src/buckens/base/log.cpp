// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/log.h"

#include <mutex>
#include <utility>

namespace buckens::base {

namespace {

struct Sink {
  std::mutex mutex;
  LogSink sink;
};

Sink& the_sink() {
  static Sink sink;
  return sink;
}

}  // namespace

void set_log_sink(LogSink sink) {
  const std::lock_guard lock(the_sink().mutex);
  the_sink().sink = std::move(sink);
}

void log(LogLevel level, const std::string& message) {
  const std::lock_guard lock(the_sink().mutex);
  if (the_sink().sink) the_sink().sink(level, message);
}

}  // namespace buckens::base
