// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Looks at the shafts that universal joints connect, where bearings on one body hold both.
/// @throws ModelError naming joint and bearings if the shafts stand across each other as placed: no
///         rotation passes a universal joint at 90 degrees, and its row is lost there
void require_bent_shafts(MarkerFinder& find);

}  // namespace buckens::model
