// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace buckens::files {

/// The whole contents of a file.
/// @param kind what the file is to the user: "model file", "table"
/// @param largest maximum size to read [bytes]
/// @throws IoError saying whether it is missing, a directory, not readable or too large
std::string read_text_file(const std::filesystem::path& path, const std::string& kind,
                           std::size_t largest = std::size_t{200} << 20);

/// Records what read_text_file() reads on this thread while the object lives: decks include other
/// files, so only reading them reveals the full list.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// FNV-1a hash of the contents by path.
  const std::map<std::filesystem::path, std::uint64_t>& hashes() const { return hashes_; }
  void add(const std::filesystem::path& path, std::string_view content);

 private:
  FilesRead* outer_;
  std::map<std::filesystem::path, std::uint64_t> hashes_;
};

}  // namespace buckens::files
