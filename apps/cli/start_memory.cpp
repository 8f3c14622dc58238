// SPDX-License-Identifier: Apache-2.0
// Ends the program with a message where its libraries could not start for want of memory.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include "cli/exit_code.h"

namespace buckens::cli {

namespace {

// Before main() begins, OpenBLAS takes as much for each of its threads, and tries again without end
// where it gets none.
constexpr std::size_t kPerThread = std::size_t{128} << 20U;
constexpr long kMostThreads = 128;  // of Debian's OpenBLAS, whatever the machine has
// What the start of all libraries needs besides.
constexpr std::size_t kBesides = std::size_t{16} << 20U;
// What the program needs besides to run small models [kB].
constexpr long kForSmallModels = 250000;
constexpr std::string_view kThreadsVariable = "OMP_NUM_THREADS=";

/// Memory that is held while this lives.
class TakenMemory {
 public:
  explicit TakenMemory(std::size_t size)
      : start_(::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)),
        size_(size) {}
  ~TakenMemory() {
    if (exists()) ::munmap(start_, size_);
  }
  TakenMemory(const TakenMemory&) = delete;
  TakenMemory& operator=(const TakenMemory&) = delete;

  bool exists() const { return start_ != MAP_FAILED; }

 private:
  void* start_;
  std::size_t size_;
};

/// Whether OpenBLAS gets what it takes for its threads: piece by piece, as the system may refuse
/// more than the machine has in one.
bool is_there_memory(long threads) {
  const TakenMemory piece(threads > 0 ? kPerThread : kBesides);
  return piece.exists() && (threads <= 0 || is_there_memory(threads - 1));
}

long threads_at_start(char** environment) {
  const long processors = std::clamp(::sysconf(_SC_NPROCESSORS_CONF), 1L, kMostThreads);
  for (; *environment != nullptr; ++environment) {
    const std::string_view variable = *environment;
    if (!variable.starts_with(kThreadsVariable)) continue;
    const long wanted = std::strtol(*environment + kThreadsVariable.size(), nullptr, 10);
    if (wanted > 0) return std::min(wanted, processors);
  }
  return processors;
}

/// What cannot be written is lost; the exit code remains.
void write_text(int stream, std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(stream, text.data(), text.size());
}

void write_reason(int stream, long threads) {
  std::array<char, 20> digits{};
  const long least = kForSmallModels + threads * static_cast<long>(kPerThread / 1024);
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), least).ptr;
  write_text(stream,
             "not enough memory: OpenBLAS takes 128 MiB of address space for each of its threads "
             "when the program starts, and a limit (ulimit -v, ulimit -d) leaves less. Set it to "
             "at least ");
  write_text(stream, {digits.data(), end});
  write_text(stream, threads > 1 ? " kB, or set OMP_NUM_THREADS=1." : " kB, or remove it.");
}

/// Runs before any library has started, so it only makes system calls.
void require_memory_at_start(int argc, char** argv, char** environment) {
  const long threads = threads_at_start(environment);
  if (is_there_memory(threads)) return;
  write_text(STDERR_FILENO, "buckens: error: ");
  write_reason(STDERR_FILENO, threads);
  write_text(STDERR_FILENO, "\n");
  if (std::find(argv, argv + argc, std::string_view("--json")) != argv + argc) {
    write_text(STDOUT_FILENO, R"({"error": {"kind": "memory", "message": ")");
    write_reason(STDOUT_FILENO, threads);
    write_text(STDOUT_FILENO, R"(", "file": null, "line": null, "column": null}})");
    write_text(STDOUT_FILENO, "\n");
  }
  ::_exit(static_cast<int>(ExitCode::numerical));
}

// Constructors of the program run after those of its libraries, this before them.
[[gnu::used,
  gnu::section(".preinit_array")]] void (*const kBeforeLibraries)(int, char**,
                                                                  char**) = require_memory_at_start;

}  // namespace

}  // namespace buckens::cli
