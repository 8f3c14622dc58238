// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// Applies "PATH=VALUE" each to the tree of a model file, in this order, as `--set` does.
///
/// PATH is a chain of keys, "bodies.rod.beam.elements", list items counted from 0, "gravity.1". It
/// must lead to something that is there, to a key that the format knows, or to a new entry of a
/// named map (sensors, loads, ...); what is added is checked with the rest of the file. VALUE is
/// YAML.
/// @throws InputError naming the nearest key; for a part of a new entry whose name resembles one
/// that is there; for a new parameter that no value uses
void apply_overrides(YamlNode& root, const std::vector<std::string>& assignments);

}  // namespace buckens::model_file
