// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace buckens::files {

/// What became of work in a process of its own.
struct IsolatedResult {
  std::string output;  ///< what the work has returned; empty if it did not come to its end
  int signal = 0;      ///< that ended the process: 11 for a wrong access to memory
  bool is_complete = false;
};

/// Does something in a copy of this process. Whatever happens there, be it that a foreign library
/// follows a wild pointer, prints, ends the process or takes all memory, this process lives on and
/// keeps its streams. The copy dies with this process, may not use more memory than the machine
/// has, and can be ended from the keyboard.
///
/// The copy has one thread; the work must not wait for others that ran before.
/// @param work in the copy; an exception ends it without a result
/// @param seconds of computing after which the copy is ended by SIGXCPU; 0: no limit
/// @throws IoError if the system grants no further process
IsolatedResult do_isolated(const std::function<std::string()>& work, unsigned seconds = 0);

/// Ends this process by SIGXCPU after so many seconds of computing from now on; meant for the work
/// itself once it knows how much there is to do.
void limit_time_from_now(double seconds);

}  // namespace buckens::files
