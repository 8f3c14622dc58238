// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/source_location.h"

namespace buckens::model_file {

struct YamlEntry;

/// A value of a YAML file as written: nothing is interpreted, every value knows its place.
struct YamlNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  std::string text;  ///< of a scalar
  bool is_quoted = false;
  SourceLocation where;
  std::vector<YamlNode> items;     ///< of a list
  std::vector<YamlEntry> entries;  ///< of a map, in the order of the file

  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_list() const { return kind == Kind::list; }
  bool is_map() const { return kind == Kind::map; }
  /// Value of a key, or null.
  const YamlNode* find(std::string_view key) const;
  YamlNode* find(std::string_view key);
  /// Follows a path such as "beams.0.section" as far as it goes.
  const YamlNode& deepest(const std::string& path) const;
  /// "a list", "a map", "no value", or the text of a scalar in quotation marks.
  std::string description() const;
};

struct YamlEntry {
  std::string key;
  SourceLocation where;
  YamlNode value;
};

/// A text, shortened for messages.
std::string shortened(const std::string& text);

/// Reads one YAML (or JSON) document.
///
/// Duplicate keys, anchors, aliases, merge keys, tags, several documents, text that is not UTF-8
/// and unreasonable depth or size are refused.
/// @param name denotes the file in messages
/// @param single_line every place is `name` itself; for values given on a command line
/// @throws InputError with line and column
YamlNode parse_yaml(const std::string& text, const std::string& name, bool single_line = false);

}  // namespace buckens::model_file
