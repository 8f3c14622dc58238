// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace buckens::cli {

/// JSON as the program prints it: indented, with a line break at the end. Broken UTF-8, which may
/// come from file names, is replaced.
std::string to_text(const nlohmann::ordered_json& json);

/// Writes to the standard output and flushes it. @throws IoError
void print(std::string_view text);

/// The same without an exception. @return whether all was written
bool try_print(std::string_view text) noexcept;

/// Writes to a message stream, such as the standard error, and flushes it. What cannot be written
/// is lost: a simulation must not end because its progress cannot be shown.
void tell(std::FILE* stream, std::string_view text) noexcept;

/// If the program was started without standard streams (`2>&-`), opens unwritable replacements:
/// otherwise files opened later would get these descriptors, and messages would go into
/// results.
void hold_standard_streams() noexcept;

}  // namespace buckens::cli
