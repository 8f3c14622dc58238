// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens {

/// Location in a text file, counted from 1. Line 0 means that only the file is known.
struct SourceLocation {
  std::string file;  ///< as the user named it; empty where nothing is known
  int line = 0;
  int column = 0;

  /// "file:line:column", "file" or "".
  std::string text() const {
    if (line <= 0) return file;
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
  }
  bool empty() const { return file.empty(); }
};

}  // namespace buckens
