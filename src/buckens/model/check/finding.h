// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace buckens::model {

/// An error in a model description, and where it is.
struct Finding {
  std::string field_path;  ///< the field to correct, "bodies.rod.beam.to"; empty: the whole
  std::string text;        ///< what is wrong, the value, the remedy
};

using Found = std::optional<Finding>;

/// "a.b"; either may be empty.
inline std::string join_path(const std::string& path, std::string_view key) {
  std::string out = path;
  if (!path.empty() && !key.empty()) out += '.';
  return out += key;
}

/// Puts "key." before the path of a finding.
inline Found under(const std::string& key, const Found& found) {
  if (!found) return found;
  return Finding{join_path(key, found->field_path), found->text};
}

}  // namespace buckens::model
