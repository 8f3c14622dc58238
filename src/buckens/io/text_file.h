// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace buckens::io {

/// The whole content of a file.
/// @param kind what the file is to the user: "model file", "table"
/// @param largest size that is read [bytes]
/// @throws IoError saying whether it is missing, a directory, not readable or too large
std::string read_text_file(const std::filesystem::path& path, const std::string& kind,
                           std::size_t largest = std::size_t{200} << 20);

}  // namespace buckens::io
