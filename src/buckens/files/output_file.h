// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace buckens::files {

/// A file written in pieces, each passed to the system at once, so that they survive if the
/// program dies.
class OutputFile {
 public:
  enum class Start {
    empty,    ///< an existing file is truncated; symbolic links are followed
    anew,     ///< an existing file or link is removed first: see open_anew()
    as_it_is  ///< appends to an existing file; symbolic links are refused
  };

  OutputFile() = default;
  /// Opens the file for appending, and creates it if needed.
  /// @throws IoError
  explicit OutputFile(const std::filesystem::path& path, Start start = Start::empty);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;

  /// @throws IoError with the system's reason, such as a full disk
  void write(std::string_view text);
  /// Empties the file. @throws IoError
  void clear();
  /// Locks the file for this process until it is closed or the process ends.
  /// @return false if another process holds it; true also where the file system has no locks
  bool try_lock();
  /// @throws IoError if the system reports a late write error
  void close();

  bool is_open() const { return descriptor_ >= 0; }
  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(std::string_view verb) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Creates a file without ever writing to somebody else's: an existing file or symbolic link is
/// removed first, and one that appears meanwhile is an error. Existing devices and pipes are
/// opened.
/// @param flags of open() besides those for creation
/// @return the descriptor, or −1 with errno as open() sets it
int open_anew(const char* path, int flags);

/// The system's text for an error number, and what a user can do about it; ends with a full
/// stop.
std::string system_reason(int error);

/// The whole contents of a file. @throws IoError
std::string read_text_file(const std::filesystem::path& path);

/// Failures that new contents of a file survive, once written.
enum class Lasting {
  process,  ///< the end of this program, however it comes
  power     ///< a loss of power, too; costs some milliseconds
};

/// Writes a file atomically: readers see the old or the new contents, never a part.
/// @throws IoError; the old contents are then kept
void replace_text_file(const std::filesystem::path& path, std::string_view text,
                       Lasting lasting = Lasting::process);

/// Returns when all data of a file or directory are on disk, if the file system supports that.
/// @throws IoError
void sync_to_disk(const std::filesystem::path& path);

/// Date and time to the second, "2026-01-31T12:00:00Z".
std::string utc_now();

}  // namespace buckens::files
