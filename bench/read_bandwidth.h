// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "stopwatch.h"

#include "buckens/base/task_pool.h"
#include "buckens/linalg/streaming_memory.h"

namespace buckens::bench {

/// Bytes per second read by `threads` threads from memory that no cache holds.
inline double read_bandwidth(int threads, double budget) {
  constexpr std::size_t kCount = std::size_t{1} << 27U;  // 1 GiB
  static linalg::StreamingMemory memory(kCount);
  static const bool is_filled = (std::fill(memory.data(), memory.data() + kCount, 1.0), true);
  TaskPool pool(threads);
  std::vector<double> sums(static_cast<std::size_t>(threads));
  const auto read = [&](int k) {
    const std::size_t share = kCount / static_cast<std::size_t>(threads);
    const double* values = memory.data() + share * static_cast<std::size_t>(k);
    double sum[32] = {};
    for (std::size_t i = 0; i + 32 <= share; i += 32) {
      for (std::size_t j = 0; j < 32; j += 8) __builtin_prefetch(values + i + j + 512);
      for (std::size_t j = 0; j < 32; ++j) sum[j] += values[i + j];
    }
    sums[static_cast<std::size_t>(k)] = std::accumulate(sum, sum + 32, 0.0);
  };
  const double seconds = shortest(budget, [&] { pool.run(threads, read); });
  volatile double keep = sums[0] + static_cast<double>(is_filled);
  static_cast<void>(keep);
  return 8.0 * static_cast<double>(kCount) / seconds;
}

}  // namespace buckens::bench
