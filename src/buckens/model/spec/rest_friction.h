// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace buckens::model {

/// Friction in an equilibrium.
enum class RestFriction {
  free,   ///< nothing: the equilibria are those without it
  frozen  ///< what rubs stays where it is, whatever force that takes
};

constexpr std::array<const char*, 2> choice_names(RestFriction) { return {"free", "frozen"}; }

}  // namespace buckens::model
