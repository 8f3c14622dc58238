// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/files/deck_number.h"

namespace buckens::files {

/// The text without the UTF-8 byte order mark that some editors write.
inline std::string without_byte_order_mark(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

/// Iterates over the lines of a text with their numbers.
class TextLines {
 public:
  /// @param text must outlive this and not change
  explicit TextLines(const std::string& text) : text_(text) {}

  /// The next line without blanks around it; false at the end.
  bool next(std::string_view& line) {
    if (position_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line = stripped(text_.substr(position_, end - position_));
    position_ = end + 1;
    ++number_;
    return true;
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  int number_ = 0;
};

/// Splits a line at blanks, or at commas with optional blanks around them.
inline void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t begin = line.find_first_not_of(", \t");
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(", \t", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(", \t", end);
  }
}

}  // namespace buckens::files
