// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/energy.h"
#include "buckens/model/state.h"
#include "buckens/results/observation.h"

namespace buckens::results {

/// State at a time between two steps: cubic in positions, rotations and nodal displacements (from
/// values and rates at both ends), linear in rates and accelerations. Error O(h⁴) in positions.
/// @param t between before.t and after.t [s]
model::State interpolate(const model::State& before, const model::State& after, double t);

/// Multipliers at time t, linear between (or beyond) the instants to which both states' λ belong.
linalg::Vector multipliers_at(const model::State& before, const model::State& after, double t);

/// Energies and work at one instant, as compared by an energy balance.
struct EnergyLevels {
  dynamics::Energy energy;
  WorkBalance work;
};

/// Between the ends of a step, linear. Energies of an interpolated state would differ from those
/// at the ends of steps by the error of its interpolation, which for stiff bodies is far larger
/// than that of the balance.
/// @param share 0 at `before`, 1 at `after`
EnergyLevels interpolate(const EnergyLevels& before, const EnergyLevels& after, double share);

}  // namespace buckens::results
