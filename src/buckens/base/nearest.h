// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace buckens::base {

/// Number of single-character edits (insert, delete, change, swap of neighbours) between two words,
/// ignoring case. Cost O(|a| |b|).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or "" if none is close enough to be a typing error.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// Ending of a message about an unknown word: ` Did you mean "x"?` where a candidate is near, else
/// ` Known are: a, b, c.`, at most twelve of them; "" without candidates.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace buckens::base
