// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/put_off_work.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/number_bytes.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_task.h"

namespace buckens::linalg {

namespace {

base::BytesTo& waiting() {
  static base::BytesTo tasks;
  return tasks;
}

/// Why work failed that was finished where nobody could be told.
std::string& untold() {
  static std::string why;
  return why;
}

}  // namespace

void PutOffWork::add(int space, std::span<const std::byte> tasks) {
  waiting()(RowTask::space);
  waiting()(space);
  waiting().all(tasks.data(), tasks.size());
}

void PutOffWork::finish_with_sums(std::size_t sums_each, double* sums) {
  if (!untold().empty()) throw NumericalError(std::exchange(untold(), {}));
  const std::vector<std::byte> program = waiting().take();
  if (program.empty()) return;
  std::array<char, 400> error{};
  const int failure = grid_solver().work_rows(program.data(), static_cast<long>(program.size()),
                                              static_cast<int>(sums_each), sums, error.data(),
                                              static_cast<int>(error.size()));
  if (failure == 0) return;
  throw NumericalError(
      fmt::format("work on vectors on {} processes failed: {}; use more memory, or "
                  "run it in one process",
                  Ranks::count(), error.data()));
}

void PutOffWork::finish_at_end() noexcept {
  try {
    finish();
  } catch (const std::exception& failure) {
    untold() = failure.what();
  }
}

}  // namespace buckens::linalg
