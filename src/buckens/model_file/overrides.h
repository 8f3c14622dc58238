// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// Applies "PATH=VALUE" overrides in order to the tree of a model file, as `--set` does.
///
/// PATH is a chain of keys, "bodies.rod.beam.elements", list items counted from 0, "gravity.1".
/// It must lead to something that exists, to a key known to the format, or to a new entry of a
/// named map (sensors, loads, ...); additions are checked with the rest of the file. VALUE is
/// YAML.
/// @throws InputError naming the nearest key; for a part of a new entry whose name resembles an
/// existing one; for a new parameter that no value uses
void apply_overrides(YamlNode& root, const std::vector<std::string>& assignments);

}  // namespace buckens::model_file
