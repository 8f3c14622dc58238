// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/base/field.h"

namespace buckens::model {

/// What a value of a field must do and does not: "be positive"; empty where all is well.
std::optional<std::string> broken_rule(const base::FieldNote& note, double value);

/// "-3 mm is not allowed: the value must be positive".
std::string refusal(const std::string& shown_value, const std::string& rule);

}  // namespace buckens::model
