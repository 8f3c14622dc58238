// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// All joint equations at one instant: g = 0, ġ = G_q q̇ + G_d ḋ + g_t = 0.       FM (20), (34)
struct Constraints {
  linalg::Vector g;             ///< residuals [m] or [-]
  linalg::Vector g_dot;         ///< their rates [m/s] or [1/s]
  linalg::Vector g_t;           ///< their partial time derivatives
  std::vector<SystemRow> rows;  ///< derivatives, one per row of λ
};

/// Evaluates every joint. Cost O(rows); reuses the vectors of `out`.
/// @param memory turns of coupled coordinates and states of rows; null: no turns yet
/// @throws NumericalError where a coupled angle passes 3 rad without memory
void evaluate_constraints(const model::Model& model, const std::vector<BodyMotion>& motions,
                          double t, const model::RowMemory* memory, Constraints& out);
/// The same without memory.
void evaluate_constraints(const model::Model& model, const std::vector<BodyMotion>& motions,
                          double t, Constraints& out);

/// Those of `rows` whose joints have not let go.
std::vector<int> held_rows(const model::Model& model, const model::RowMemory& memory,
                           const std::vector<int>& rows);

/// For each row of λ whether it holds its rate only, as rolling does. Its residual is zero.
std::vector<char> rate_only_rows(const model::Model& model);

/// The part of g̈ without coordinate accelerations, for the initial accelerations.
linalg::Vector constraint_bias(const model::Model& model, const std::vector<BodyMotion>& motions,
                               double t, const model::RowMemory* memory = nullptr);

}  // namespace buckens::dynamics
