// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/base/field.h"

namespace buckens::model {

/// The requirement that a value of a field violates: "be positive"; empty if there is none.
std::optional<std::string> broken_rule(const base::FieldNote& note, double value);

/// "-3 mm is not allowed: the value must be positive".
std::string refusal(const std::string& shown_value, const std::string& rule);

}  // namespace buckens::model
