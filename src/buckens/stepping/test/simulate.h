// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/stepping/stepper.h"

namespace buckens::test {

/// State after `duration`, a whole number of steps.
inline model::State simulate(const model::Model& model, const Start& start,
                             const stepping::StepSettings& settings, double duration) {
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  const long steps = std::lround(duration / settings.step);
  for (long k = 0; k < steps; ++k) stepper.step(state);
  return state;
}

/// Settings whose iteration errors stay far below those of the step.
inline stepping::StepSettings settings(stepping::Method method, double h) {
  stepping::StepSettings out;
  out.method = method;
  out.step = h;
  out.newton_tolerance = 1e-12;
  out.outer_tolerance = 1e-10;
  out.iterate_coupling = true;
  return out;
}

/// Position in the world of a node of a flexible body.
inline Eigen::Vector3d node_position(const model::Model& model, const model::State& state,
                                     std::size_t body, std::size_t node) {
  const body::Body& b = model.bodies[body];
  Eigen::Vector3d p = b.flexible->fe.nodes[node].position - b.com;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int dof = b.flexible->fe.dofs.node_dofs[node][axis];
    if (dof >= 0) p[static_cast<Eigen::Index>(axis)] += state.bodies[body].d[dof];
  }
  return state.bodies[body].frame.X_WB * p;
}

/// Observed order from errors with step h and with step h/2.
inline double observed_order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace buckens::test
