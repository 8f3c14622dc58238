// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace buckens::model_file {

/// An unclosed bracket.
struct OpenBracket {
  char bracket;      ///< [ or {
  int line, column;  ///< from 1
};

/// The innermost bracket open at a position of a YAML text, or an earlier one closed by a bracket
/// of the other kind; empty if all are closed. Handles comments and quotes.
/// @param position index into the text where a parser failed
std::optional<OpenBracket> unclosed_bracket(const std::string& text, int position);

}  // namespace buckens::model_file
