// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/body/body_spec.h"

namespace buckens::body {

/// What in a body's description conflicts with the requested reduction or flexibility.
struct ReductionConflict {
  std::string key;   ///< of the model file, within the body
  std::string text;  ///< what is wrong and what to do
};

std::optional<ReductionConflict> reduction_conflict(const BodySpec& spec);

}  // namespace buckens::body
