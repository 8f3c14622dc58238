// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::cli {

/// Exit codes of the program; documented in docs/reference/command-line.md.
enum class ExitCode : int {
  ok = 0,
  internal = 1,       ///< a bug in Buckens itself
  input = 2,          ///< model file or command line
  model = 3,          ///< readable, but the mechanism cannot be built or solved
  numerical = 4,      ///< a calculation failed, or memory ran out
  io = 5,             ///< a file cannot be read or written
  different = 6,      ///< two runs differ by more than the tolerance
  interrupted = 130,  ///< Ctrl-C, SIGTERM or SIGHUP; what was computed is complete
};

}  // namespace buckens::cli
