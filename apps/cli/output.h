// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace buckens::cli
