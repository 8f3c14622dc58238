// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace buckens::model_file {

/// What to say about a key that the format does not have but users look for: something that is not
/// supported yet and what to do instead, or the name that it has here. Empty for other keys.
/// @param path of the map that holds the key: "joints.hinge"
std::optional<std::string> advice_on_key(const std::string& key, const std::string& path);

}  // namespace buckens::model_file
