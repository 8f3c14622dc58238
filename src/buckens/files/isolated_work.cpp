// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/isolated_work.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/base/sanitizers.h"
#include "buckens/files/output_file.h"

#if BUCKENS_IS_SANITIZED
#define BUCKENS_UNDER_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BUCKENS_UNDER_SANITIZER
#endif
#endif

namespace buckens::files {

namespace {

constexpr char kEnd = '\x04';  // after the output of completed work

/// To what the machine has. Sanitizers reserve more addresses than that for themselves.
void limit_memory() {
#if !defined(BUCKENS_UNDER_SANITIZER)
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || size <= 0) return;
  const auto bytes = static_cast<rlim_t>(pages) * static_cast<rlim_t>(size);
  const rlimit memory = {bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

void keep_to_itself() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGSEGV, SIGFPE, SIGABRT, SIGXCPU}) {
    ::signal(number, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_RDWR);
  for (int stream = 0; nothing >= 0 && stream < 3; ++stream) ::dup2(nothing, stream);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory();
}

void send(int pipe, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(pipe, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(1);
    done += static_cast<std::size_t>(count);
  }
}

std::string received(int pipe) {
  std::string out;
  std::array<char, 1 << 16> piece;
  for (;;) {
    const ssize_t count = ::read(pipe, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return out;
    out.append(piece.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

void limit_time_from_now(double seconds) {
  rusage used = {};
  rlimit limit = {};
  ::getrusage(RUSAGE_SELF, &used);
  ::getrlimit(RLIMIT_CPU, &limit);
  const auto so_far = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  const auto until = static_cast<rlim_t>(std::clamp(so_far + seconds + 1, 1.0, 1e9));
  // The hard limit stays: once lowered it cannot be raised again.
  limit.rlim_cur = std::min(until, limit.rlim_max);
  ::setrlimit(RLIMIT_CPU, &limit);
}

IsolatedResult do_isolated(const std::function<std::string()>& work, unsigned seconds) {
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw IoError(fmt::format("cannot start a process: {}", system_reason(errno)));
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    keep_to_itself();
    if (seconds > 0) limit_time_from_now(seconds);
    try {
      send(ends[1], work() + kEnd);
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);  // no destructors of static objects: they belong to the other process
  }
  const int error = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw IoError(fmt::format("cannot start a process: {}", system_reason(error)));
  }
  IsolatedResult out;
  out.output = received(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) out.signal = WTERMSIG(status);
  out.is_complete = !out.output.empty() && out.output.back() == kEnd;
  if (out.is_complete) {
    out.output.pop_back();
  } else {
    out.output.clear();
  }
  return out;
}

}  // namespace buckens::files
