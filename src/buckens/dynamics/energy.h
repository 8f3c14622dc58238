// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// Energies of the mechanism [J].
struct Energy {
  double kinetic = 0;
  double strain = 0;
  double gravity = 0;  ///< −Σ m g·p, zero at Model::origin
  double springs = 0;
  double total() const { return kinetic + strain + gravity + springs; }
};

/// Energies at a state, FM (13): with J₀ for `none` and rigid bodies, with J₀ + J₁ for
/// `first-order`, exact otherwise.
/// Cost: a product with M and K per flexible body.
/// @param pool shares the products of large bodies, or null
Energy energy(const model::Model& model, const model::State& state, TaskPool* pool = nullptr);

/// Difference between the gravitational energy relative to the origin of the model file and
/// Energy::gravity, by the gravity that the model begins with: a constant, so that what an event
/// changes is the same in both. Kept separate so that differences of energies lose no digits far
/// away.
double gravity_datum(const model::Model& model);

/// Linear momentum [N s] and angular momentum about Model::origin [N m s], world axes.
struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};
Momentum momentum(const model::Model& model, const model::State& state);

}  // namespace buckens::dynamics
