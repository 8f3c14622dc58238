// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace buckens::files {

/// Adds a member to a JSON object in its order. Objects that keep an order compare each new name
/// with all others, which takes a time with the square of their number; here the caller knows that
/// it is new.
inline void add_member(nlohmann::ordered_json& object, const std::string& name,
                       nlohmann::ordered_json value) {
  object.get_ref<nlohmann::ordered_json::object_t&>().emplace_back(name, std::move(value));
}

}  // namespace buckens::files
