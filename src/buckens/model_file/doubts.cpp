// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/doubts.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/units.h"

namespace buckens::model_file {

namespace {

/// Whether all values below are plain numbers. A unit, or an expression of parameters that may have
/// one, shows that the author considered units.
bool has_bare_numbers(const YamlNode& node) {
  if (node.is_scalar()) {
    return base::parse_number(node.text).has_value() ||
           base::split_quantity(node.text).unit.empty();
  }
  return std::all_of(node.items.begin(), node.items.end(), has_bare_numbers) &&
         std::all_of(node.entries.begin(), node.entries.end(),
                     [](const YamlEntry& entry) { return has_bare_numbers(entry.value); });
}

}  // namespace

std::vector<std::string> doubt_warnings(const YamlNode& root,
                                        const std::vector<model::Doubt>& doubts) {
  std::vector<std::string> out;
  for (const model::Doubt& doubt : doubts) {
    const YamlNode& node = root.deepest(doubt.path);
    const bool is_bare = has_bare_numbers(node);
    if (doubt.only_without_unit && !is_bare) continue;
    const std::string given = node.is_scalar() ? fmt::format("\"{}\" is ", node.text) : "";
    const std::string advice = is_bare && !doubt.likely.empty()
                                   ? fmt::format("; did you mean {}?", doubt.likely)
                                   : "; check the value and its unit";
    out.push_back(
        fmt::format("{}: {}: {}{}{}", node.where.text(), doubt.path, given, doubt.text, advice));
  }
  return out;
}

}  // namespace buckens::model_file
