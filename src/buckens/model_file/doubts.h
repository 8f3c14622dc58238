// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/check/plausibility.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

/// Warnings about doubtful values, each with its place, path, the text of the model file, and the
/// unit that was probably meant if none was written.
/// @param root tree of the model file, overrides applied
std::vector<std::string> doubt_warnings(const YamlNode& root,
                                        const std::vector<model::Doubt>& doubts);

}  // namespace buckens::model_file
