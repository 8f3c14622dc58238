// SPDX-License-Identifier: Apache-2.0
#include "cli/output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::cli {

std::string to_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

bool try_print(std::string_view text) noexcept {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
         std::fflush(stdout) == 0;
}

void print(std::string_view text) {
  if (!try_print(text)) {
    throw IoError(fmt::format("cannot write to the standard output: {}.", std::strerror(errno)));
  }
}

}  // namespace buckens::cli
