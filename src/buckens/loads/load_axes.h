// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace buckens::loads {

/// Axes in which a load is given: world axes, or those of its marker or body, which the load then
/// follows.
enum class LoadAxes { fixed, following };

constexpr std::array<const char*, 2> choice_names(LoadAxes) { return {"fixed", "following"}; }

}  // namespace buckens::loads
