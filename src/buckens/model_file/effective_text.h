// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// The text of a model file after its tree was changed. Lines of unchanged entries are kept as
/// written, including comments and units; changed entries are rewritten.
/// @param text from which `before` was read, without byte order mark
/// @param after `before` with some values replaced and some entries added
/// @return a text that reads as `after`
std::string effective_text(const std::string& text, const YamlNode& before, const YamlNode& after);

/// A tree as YAML text.
std::string yaml_text(const YamlNode& root);

/// Whether two trees have the same contents, regardless of places.
bool same_content(const YamlNode& a, const YamlNode& b);

}  // namespace buckens::model_file
