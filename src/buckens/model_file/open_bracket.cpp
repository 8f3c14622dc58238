// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/open_bracket.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <vector>

namespace buckens::model_file {

std::optional<OpenBracket> unclosed_bracket(const std::string& text, int position) {
  std::vector<OpenBracket> open;
  int line = 1, column = 0;
  char quote = 0;
  const auto end = static_cast<std::size_t>(std::max(position, 0)) + 1;
  for (std::size_t i = 0; i < std::min(text.size(), end); ++i) {
    const char c = text[i];
    ++column;
    if (c == '\n') {
      ++line;
      column = 0;
    } else if (quote != 0) {
      if (c == '\\' && quote == '"') {
        ++i;
        ++column;
      } else if (c == quote) {
        quote = 0;
      }
    } else if (c == '#' && (i == 0 || std::isspace(static_cast<unsigned char>(text[i - 1])) != 0)) {
      const std::size_t next = std::min(text.find('\n', i), text.size());
      column += static_cast<int>(next - i) - 1;
      i = next - 1;
    } else if ((c == '"' || c == '\'') && (i == 0 || std::strchr(" \t\n[{,:", text[i - 1]))) {
      quote = c;
    } else if (c == '[' || c == '{') {
      open.push_back({c, line, column});
    } else if ((c == ']' || c == '}') && !open.empty()) {
      if (open.back().bracket != (c == ']' ? '[' : '{')) return open.back();
      open.pop_back();
    }
  }
  if (open.empty()) return std::nullopt;
  return open.back();
}

}  // namespace buckens::model_file
