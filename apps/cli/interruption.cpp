// SPDX-License-Identifier: Apache-2.0
#include "cli/interruption.h"

#include <cerrno>
#include <string_view>

#include <unistd.h>

namespace buckens::cli {

namespace {

volatile std::sig_atomic_t asked_by_parent = 0;
volatile std::sig_atomic_t asked_by_others = 0;  // the terminal, for one
volatile std::sig_atomic_t announce_request = 0;

bool is_stop_requested() { return asked_by_parent != 0 || asked_by_others != 0; }

extern "C" void request_stop(int number, siginfo_t* origin, void* /*context*/) {
  const int saved = errno;
  const bool is_first = !is_stop_requested();
  const bool is_from_parent = origin->si_code == SI_USER && origin->si_pid == ::getppid();
  volatile std::sig_atomic_t& asked = is_from_parent ? asked_by_parent : asked_by_others;
  if (asked != 0) {  // asked before: now at once
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  asked = 1;
  if (is_first && announce_request != 0) {
    constexpr std::string_view text =
        "\nstopping after the current step; press Ctrl-C again to stop at once\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  }
  errno = saved;
}

}  // namespace

Interruption::Interruption(bool announce) {
  asked_by_parent = 0;
  asked_by_others = 0;
  announce_request = announce ? 1 : 0;
  struct sigaction action = {};
  action.sa_sigaction = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART | SA_SIGINFO;  // no half-done system calls
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interruption::requested() const { return is_stop_requested(); }

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace buckens::cli
