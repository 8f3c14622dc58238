// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace buckens::cli {

/// Columns of text: the first one left-aligned, the others right-aligned. The first row is the
/// heading. Every line begins with two blanks.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// "  name ....... value" with the values in one column.
std::string text_list(const std::vector<std::pair<std::string, std::string>>& entries);

/// `count` and the noun, "1 body", "2 bodies".
std::string counted(long count, const std::string& singular, const std::string& plural = {});

}  // namespace buckens::cli
