// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/statics/linearised_loads.h"
#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Coordinates of one body, followed by its momenta.
struct RestBody : BodyCoordinates {
  int momenta = 0;  ///< relative momentum l = Lᵀd of a deformed body: 0 or 3

  int size() const { return num_frame() + rows + momenta; }
};

/// What joints and loads contribute to small motions about a state of rest, in the coordinates s of
/// all bodies: frames, interface values and momenta, body by body.
struct RestTangent {
  std::vector<RestBody> bodies;
  int size = 0;
  linalg::SparseMatrix rows;       ///< G: independent joint equations over s, G s = 0
  linalg::SparseMatrix stiffness;  ///< Γ: minus the loads on s per s; symmetric
  double asymmetry = 0;            ///< ‖Γ − Γᵀ‖/‖Γ‖ before symmetrising
};

enum class RestLoads {
  springs,  ///< stiffness of springs and bushings alone, as if nothing were loaded
  all       ///< derivative of all loads and joint forces, including gravity and preload
};

/// Rows of force laws that hold at rest, as joints do.
struct ClosedRows {
  const RestRows& rest;
  RestStands stands;
  std::vector<int> in_use;  ///< closed and independent of joints and each other
};

/// Linearises joints and loads at rest.
///
/// `all`: as LinearisedLoads; correct if the state is an equilibrium.
/// @param state velocities are taken as zero, @param closed null: joints alone
RestTangent rest_tangent(const model::Model& model, const model::State& state,
                         const std::vector<int>& rows_in_use, RestLoads loads,
                         const ClosedRows* closed = nullptr);

}  // namespace buckens::analysis
