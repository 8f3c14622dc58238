// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace buckens::files {

/// Outcome of work done in a separate process.
struct IsolatedResult {
  std::string output;  ///< what the work returned; empty if it did not finish
  int signal = 0;      ///< that ended the process: 11 for a segmentation fault
  bool is_complete = false;
};

/// Hears what the work writes to its standard output, one line at a time without its end; an empty
/// line every half second of silence. Must not throw.
using IsolatedListener = std::function<void(const std::string& line)>;

/// Runs work in a forked copy of this process. Whatever happens there (a foreign library follows a
/// wild pointer, prints, exits or uses up all memory), this process survives and keeps its streams.
/// The copy dies with this process, cannot use more memory than the machine has, and can be
/// interrupted from the keyboard.
///
/// The copy has one thread; the work must not wait for threads of this process.
/// @param work run in the copy; an exception ends it without a result
/// @param seconds of processor time after which SIGXCPU ends the copy; 0: no limit
/// @param listener empty: what the work writes is lost
/// @throws IoError if the system cannot start another process
IsolatedResult do_isolated(const std::function<std::string()>& work, unsigned seconds = 0,
                           const IsolatedListener& listener = {});

/// For the work itself: says a line to the listener.
void say_to_listener(const std::string& line);

/// Ends this process by SIGXCPU after so many more seconds of processor time; for the work itself
/// to call once it knows how much there is to do.
void limit_time_from_now(double seconds);

}  // namespace buckens::files
