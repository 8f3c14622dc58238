// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace buckens::model_file {

/// A bracket that nothing closes.
struct OpenBracket {
  char bracket;      ///< [ or {
  int line, column;  ///< from 1
};

/// The innermost bracket that is open at a place of a YAML text, or one that a bracket of the other
/// kind meets before it; nothing where all are closed. Knows comments and quotes.
/// @param position index into the text where a parser gave up
std::optional<OpenBracket> unclosed_bracket(const std::string& text, int position);

}  // namespace buckens::model_file
