// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace buckens::model_file {

/// Message about a key that the format does not have but users may try: something not supported yet
/// and what to do instead, or its name here. Empty for other keys.
/// @param path of the map containing the key: "joints.hinge"
std::optional<std::string> advice_on_key(const std::string& key, const std::string& path);

}  // namespace buckens::model_file
