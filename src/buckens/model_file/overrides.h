// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// Applies "PATH=VALUE" to the tree of a model file, as `--set` does.
///
/// PATH is a chain of keys, "bodies.rod.beam.elements", list items counted from 0, "gravity.1". It
/// must lead to something that is there, or to a key that the format knows; entries of named maps
/// (bodies, parameters, ...) must exist. VALUE is YAML.
/// @throws InputError naming the nearest key
void apply_override(YamlNode& root, const std::string& assignment);

}  // namespace buckens::model_file
