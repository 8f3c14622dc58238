// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/isolated_work.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
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

/// @param listener where the standard output goes; -1: nowhere
void keep_to_itself(int listener) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGSEGV, SIGFPE, SIGABRT, SIGXCPU}) {
    ::signal(number, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_RDWR);
  for (int stream = 0; nothing >= 0 && stream < 3; ++stream) ::dup2(nothing, stream);
  if (listener >= 0) ::dup2(listener, STDOUT_FILENO);
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

/// Both ends of a pipe; those that are open are closed at the end.
struct Pipe {
  std::array<int, 2> ends = {-1, -1};  // to read, to write

  void open() {
    if (::pipe2(ends.data(), O_CLOEXEC) == 0) return;
    throw IoError(fmt::format("cannot start a process: {}", system_reason(errno)));
  }
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
  Pipe() = default;
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

/// Reads once. @return whether there may be more
bool read_some(int pipe, std::string& text) {
  std::array<char, 1 << 16> piece;
  const ssize_t count = ::read(pipe, piece.data(), piece.size());
  if (count < 0 && errno == EINTR) return true;
  if (count > 0) text.append(piece.data(), static_cast<std::size_t>(count));
  return count > 0;
}

void hear_lines(std::string& text, const IsolatedListener& listener) {
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    if (end > begin) listener(text.substr(begin, end - begin));
  }
  text.erase(0, begin);
}

/// What comes through the first pipe until its end, while a listener hears the other.
std::string received(Pipe& output, Pipe& said, const IsolatedListener& listener) {
  constexpr int kSilence = 500;  // [ms]
  std::string out, lines;
  for (;;) {
    std::array<pollfd, 2> waiting = {{{output.ends[0], POLLIN, 0}, {said.ends[0], POLLIN, 0}}};
    const int count = ::poll(waiting.data(), waiting.size(), listener ? kSilence : -1);
    if (count < 0 && errno != EINTR) return out;
    if (count == 0) listener({});
    if (count <= 0) continue;
    if (waiting[1].revents != 0) {
      if (!read_some(said.ends[0], lines)) said.close(0);
      hear_lines(lines, listener);
    }
    if (waiting[0].revents != 0 && !read_some(output.ends[0], out)) return out;
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

void say_to_listener(const std::string& line) {
  const std::string text = line + '\n';
  [[maybe_unused]] const ssize_t ignored = ::write(STDOUT_FILENO, text.data(), text.size());
}

IsolatedResult do_isolated(const std::function<std::string()>& work, unsigned seconds,
                           const IsolatedListener& listener) {
  Pipe output, said;
  output.open();
  if (listener) said.open();
  const pid_t child = ::fork();
  if (child == 0) {
    output.close(0);
    keep_to_itself(said.ends[1]);
    if (seconds > 0) limit_time_from_now(seconds);
    try {
      send(output.ends[1], work() + kEnd);
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);  // no destructors of static objects: they belong to the other process
  }
  if (child < 0) {
    throw IoError(fmt::format("cannot start a process: {}", system_reason(errno)));
  }
  output.close(1);
  said.close(1);
  IsolatedResult out;
  out.output = received(output, said, listener);
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
