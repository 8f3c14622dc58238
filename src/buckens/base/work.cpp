// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/work.h"

#include <mutex>
#include <utility>

namespace buckens::base {

namespace {

struct WorkListener {
  std::mutex mutex;
  WorkSink sink;
};

WorkListener& the_listener() {
  static WorkListener listener;
  return listener;
}

}  // namespace

void set_work_sink(WorkSink sink) {
  const std::lock_guard lock(the_listener().mutex);
  the_listener().sink = std::move(sink);
}

void report_work(const Work& work) {
  const std::lock_guard lock(the_listener().mutex);
  if (the_listener().sink) the_listener().sink(work);
}

}  // namespace buckens::base
