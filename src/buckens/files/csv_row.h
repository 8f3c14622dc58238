// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace buckens::files {

/// A cell as RFC 4180 requires: quoted if it contains a comma, a quote or a line break.
std::string csv_cell(const std::string& text);

/// The cells of a line; empty if a quote is not closed.
std::optional<std::vector<std::string>> split_csv_row(const std::string& line);

}  // namespace buckens::files
