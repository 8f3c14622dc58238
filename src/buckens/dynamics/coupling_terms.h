// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/common_table.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// The terms of the inertial coupling that need all of d, FM (19), (21)–(24): moments quadratic in
/// d for the frame equation, and nodal loads. Terms that are not kept are zero, their load empty.
/// The instant is left at zero.
model::Coupling evaluate_coupling(const body::Body& body, const body::CouplingTerms& terms,
                                  const linalg::Vector& d, const linalg::Vector& d_dot,
                                  const linalg::Vector& d_ddot, const Eigen::Vector3d& w,
                                  const Eigen::Vector3d& w_dot);
/// The same into `out`, whose buffers are reused.
/// @param pool processes nodes of solids in parallel, with the same result
/// @param common holds the scalar mass matrix to be read of a solid; null: the body's own
void evaluate_coupling(const body::Body& body, const body::CouplingTerms& terms,
                       const linalg::Vector& d, const linalg::Vector& d_dot,
                       const linalg::Vector& d_ddot, const Eigen::Vector3d& w,
                       const Eigen::Vector3d& w_dot, model::Coupling& out, TaskPool* pool = nullptr,
                       const linalg::CommonTable* common = nullptr);

/// All moments of the frame equation: J₀, J₁ from the six numbers z = c_ab·d, and the quadratic
/// parts.
/// @param z InertiaInvariants::pattern_values(d); not read if the terms do not need it
body::DeformedMoments frame_moments(const body::Body& body, const body::CouplingTerms& terms,
                                    const body::DeformedMoments& quadratic,
                                    const Eigen::Matrix<double, 6, 1>& z,
                                    const Eigen::Matrix<double, 6, 1>& z_dot);

/// Weights of the six centrifugal load patterns; zero if the term is not kept.
Eigen::Matrix<double, 6, 1> centrifugal_weights(const body::CouplingTerms& terms,
                                                const Eigen::Vector3d& w);

/// How the coupling at an instant follows from those of the state.
struct Extrapolation {
  std::array<const model::Coupling*, 3> known{};
  std::array<double, 3> weights{};
  std::size_t count = 0;          ///< of them that count
  body::DeformedMoments moments;  ///< at the instant
};
Extrapolation extrapolation_of(const model::BodyState& state, int history, double t);

/// Coupling at t, extrapolated from the instants of the state by the parabola, line or constant
/// through `history` of them. Steps may differ in length.
/// @param pool processes the variables in parallel, with the same result
void extrapolate(const model::BodyState& state, int history, double t, model::Coupling& out,
                 TaskPool* pool = nullptr);

}  // namespace buckens::dynamics
