// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/state.h"

namespace buckens::results {

/// State at a time between two steps: cubic in positions, rotations and nodal displacements (from
/// values and rates at both ends), linear in rates and accelerations. Error O(h⁴) in positions.
/// @param t between before.t and after.t [s]
model::State interpolate(const model::State& before, const model::State& after, double t);

/// Multipliers at time t, linear between (or beyond) the instants to which both states' λ belong.
linalg::Vector multipliers_at(const model::State& before, const model::State& after, double t);

}  // namespace buckens::results
