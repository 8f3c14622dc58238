// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// The text of a model file after its tree was changed. Lines of entries that are as they were stay
/// as they are written, comments and units included; changed entries are written anew.
/// @param text from which `before` was read, without byte order mark
/// @param after `before` with some values replaced and some entries added
/// @return a text that is read as `after`
std::string effective_text(const std::string& text, const YamlNode& before, const YamlNode& after);

/// A tree as YAML text.
std::string yaml_text(const YamlNode& root);

/// Whether two trees say the same, wherever it stands.
bool same_content(const YamlNode& a, const YamlNode& b);

}  // namespace buckens::model_file
