// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/mesh_io/nastran/names.h"

namespace buckens::mesh_io {

/// One file of a deck.
struct NastranFile {
  std::string name;  ///< as shown in messages
  std::string text;
};

/// A line without its comment, not blank.
struct NastranLine {
  const NastranFile* file = nullptr;
  int number = 0;
  std::string_view text;  ///< in NastranFile::text
};

/// Returns the text of an included file. @throws IoError
using LoadNastranFile = std::function<std::string(const std::filesystem::path&)>;

/// The lines of a deck in order, those of included files in place of their INCLUDE.
///
/// Comments are removed, names in them kept. A file may be included only once: a second time would
/// repeat its numbers, whether in a cycle or not.
class NastranSource {
 public:
  /// @param name of the main file, as the user named it
  NastranSource(const std::filesystem::path& name, std::string text, LoadNastranFile load);

  /// The next line; empty at the end.
  /// @throws InputError for a zero byte or a bad INCLUDE, IoError if a file cannot be read
  std::optional<NastranLine> next();

  const NastranFile& main_file() const { return files_.front(); }
  const NastranNames& names() const { return names_; }

 private:
  struct Open {
    const NastranFile* file = nullptr;
    std::size_t place = 0;  ///< in its text
    int line = 0;
  };

  std::optional<NastranLine> raw_line();
  std::string include_argument(const NastranLine& line);
  void include(const NastranLine& line);
  std::filesystem::path resolve(const std::string& argument, const NastranFile& from) const;

  std::deque<NastranFile> files_;
  std::vector<std::string> keys_;  // of files_: identifies them; empty before INCLUDE
  std::vector<Open> open_;
  std::size_t total_size_ = 0;  // of included files
  LoadNastranFile load_;
  NastranNames names_;
};

/// Reads an included file. Only regular files: a pipe could block the reader forever.
/// @throws IoError
std::string load_nastran_file(const std::filesystem::path& path);

}  // namespace buckens::mesh_io
