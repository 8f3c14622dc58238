// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/check/plausibility.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// Warnings about doubtful values with the place of each, its path, the text of the model file, and
/// the unit that was probably meant where none was written.
/// @param root tree of the model file, overrides applied
std::vector<std::string> doubt_warnings(const YamlNode& root,
                                        const std::vector<model::Doubt>& doubts);

}  // namespace buckens::model_file
