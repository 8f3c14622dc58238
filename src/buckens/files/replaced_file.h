// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "buckens/files/output_file.h"

namespace buckens::files {

/// Writes a file atomically as replace_text_file() does, whoever writes it.
/// @param write gets another path, to which it writes; what it throws leaves the old contents
/// @throws IoError
void replace_file(const std::filesystem::path& path, Lasting lasting,
                  const std::function<void(const std::filesystem::path& part)>& write);

}  // namespace buckens::files
