// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace buckens::files {

/// A file written piece by piece, each piece handed to the system at once: what was written
/// survives the death of the program.
class OutputFile {
 public:
  enum class Start {
    empty,    ///< an old file is emptied; through a symbolic link, the file it leads to
    anew,     ///< an old file or link is removed first: see open_anew()
    as_it_is  ///< goes on behind what is there; symbolic links are refused
  };

  OutputFile() = default;
  /// Opens the file for writing at its end and creates it if needed.
  /// @throws IoError
  explicit OutputFile(const std::filesystem::path& path, Start start = Start::empty);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;

  /// @throws IoError with the system's reason, for instance a full disk
  void write(std::string_view text);
  /// Empties the file. @throws IoError
  void clear();
  /// Takes the file for this process until it is closed or the process ends.
  /// @return false if another process holds it; true also where the file system knows no locks
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

/// Creates a file of this name where nobody else's is written to: an old file or symbolic link goes
/// first, and one that somebody puts there in between is an error. Devices and pipes are opened.
/// @param flags of open() besides those for creation
/// @return the descriptor, −1 with errno as open() has it
int open_anew(const char* path, int flags);

/// What the system says about an error number, and what a user can do about it; ends in a full
/// stop.
std::string system_reason(int error);

/// The whole content of a file. @throws IoError
std::string read_text_file(const std::filesystem::path& path);

/// Writes a file so that readers see the old content or the new one, never a part of it.
/// @throws IoError; the old content then stays
void replace_text_file(const std::filesystem::path& path, std::string_view text);

/// Seconds-exact time of day, "2026-01-31T12:00:00Z".
std::string utc_now();

}  // namespace buckens::files
