// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "buckens/results/geometry.h"

namespace buckens::page {

/// Body, marker and position of a place.
nlohmann::ordered_json side_json(const results::GeometrySide& side);

/// Shapes of contact as the page draws them.
nlohmann::ordered_json shapes_json(const results::Geometry& geometry);

/// Cables and belts with what they run around.
nlohmann::ordered_json cables_json(const results::Geometry& geometry);

}  // namespace buckens::page
