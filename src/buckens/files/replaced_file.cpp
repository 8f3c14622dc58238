// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/replaced_file.h"

#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::files {

void replace_file(const std::filesystem::path& path, Lasting lasting,
                  const std::function<void(const std::filesystem::path& part)>& write) {
  std::filesystem::path part = path;
  part += ".part";
  std::error_code error;
  try {
    write(part);
    if (lasting == Lasting::power) sync_to_disk(part);
    std::filesystem::rename(part, path, error);
    if (error) {
      throw IoError(
          fmt::format("{}: cannot replace the file: {}.", path.string(), error.message()));
    }
    if (lasting == Lasting::power) sync_to_disk(path.has_parent_path() ? path.parent_path() : ".");
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace buckens::files
