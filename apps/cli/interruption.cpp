// SPDX-License-Identifier: Apache-2.0
#include "cli/interruption.h"

#include <cerrno>
#include <string_view>

#include <unistd.h>

namespace buckens::cli {

namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t announce_request = 0;

extern "C" void request_stop(int number) {
  const int saved = errno;
  if (stop_requested != 0) {  // asked before: now at once
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  stop_requested = 1;
  if (announce_request != 0) {
    constexpr std::string_view text =
        "\nstopping after the current step; press Ctrl-C again to stop at once\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  }
  errno = saved;
}

}  // namespace

Interruption::Interruption(bool announce) {
  stop_requested = 0;
  announce_request = announce ? 1 : 0;
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // no half-done system calls
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interruption::requested() const { return stop_requested != 0; }

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace buckens::cli
