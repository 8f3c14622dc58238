// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "buckens/model/build/build_model.h"

namespace buckens::model::test {

/// The marker of this name on the first body that has one.
inline const body::Marker& marker(const BuiltModel& built, const std::string& name) {
  for (const body::Body& body : built.model.bodies) {
    const int index = body.find_marker(name);
    if (index >= 0) return body.markers[static_cast<std::size_t>(index)];
  }
  throw std::out_of_range(name);
}

}  // namespace buckens::model::test
