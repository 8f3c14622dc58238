// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>

namespace buckens::cli {

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only requests a stop; the second
/// one ends the program at once.
///
/// The parent process may pass on a Ctrl-C that the terminal has sent to both: one signal from the
/// parent and one from elsewhere are the same request.
///
/// Signals that were ignored when the program started (nohup, background jobs) stay ignored. Only
/// one object at a time.
class Interruption {
 public:
  /// @param announce acknowledge the request on the standard error stream
  explicit Interruption(bool announce);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_ = {};
};

/// Failed writes are reported by the calls themselves, not by signals that end the program: broken
/// pipes (SIGPIPE) and the limit of file sizes (SIGXFSZ).
void ignore_write_signals();

}  // namespace buckens::cli
