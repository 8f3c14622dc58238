// SPDX-License-Identifier: Apache-2.0
// Loaded before the program (LD_PRELOAD), it counts the requests of its process for large memory,
// whose number so far stands in the file LACKING_COUNT. The one of number LACKING_AT fails.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kLarge = 1U << 18U;

/// Whether there is memory.
bool is_granted() {
  static std::atomic<long> count = 0;
  const long number = ++count;
  if (const char* file = std::getenv("LACKING_COUNT"); file != nullptr) {
    if (std::FILE* to = std::fopen(file, "w"); to != nullptr) {
      std::fprintf(to, "%ld\n", number);
      std::fclose(to);
    }
  }
  const char* lacking = std::getenv("LACKING_AT");
  return lacking == nullptr || number != std::atol(lacking);
}

}  // namespace

void* operator new(std::size_t size) {
  void* out = size < kLarge || is_granted() ? std::malloc(size > 0 ? size : 1) : nullptr;
  if (out == nullptr) throw std::bad_alloc();
  return out;
}
