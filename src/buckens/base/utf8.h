// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace buckens::base {

/// Length of the UTF-8 character that begins at byte `at` of a text, 0 if there is none: a stray or
/// missing byte, an overlong form, a UTF-16 surrogate, a number beyond U+10FFFF, or a
/// NUL.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Whether a text is valid UTF-8 without NUL.
bool is_utf8(std::string_view text);

}  // namespace buckens::base
