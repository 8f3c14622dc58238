// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <sys/types.h>

namespace buckens::files {

/// A second process that writes to a file on behalf of this one.
///
/// SIGKILL can end a process in the middle of a large write, since the kernel writes page by page.
/// A write requested here is either completed or, if this process is killed while it passes on the
/// bytes, not done at all. The second process ends when the object is destroyed or when this
/// process dies in any way.
///
/// It starts as a copy of this process: start it before much memory is in use. It keeps no file of
/// this process open except the given one, and ignores signals from the terminal.
class WriteProcess {
 public:
  /// @throws IoError if the system cannot create another process
  WriteProcess();
  ~WriteProcess();
  WriteProcess(const WriteProcess&) = delete;
  WriteProcess& operator=(const WriteProcess&) = delete;

  /// Directs subsequent writes to this open file; the caller keeps and closes its own descriptor.
  /// @return 0 or the error number
  int take_file(int descriptor);
  /// Returns when the bytes have reached the system.
  /// @return 0 or the error number; EPIPE: the second process has ended
  int write(std::uint64_t address, const void* bytes, std::size_t size);
  pid_t id() const { return child_; }

 private:
  int answer() const;

  int socket_ = -1;
  pid_t child_ = -1;
};

}  // namespace buckens::files
