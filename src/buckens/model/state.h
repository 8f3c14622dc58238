// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/joints/joint_coordinate.h"
#include "buckens/linalg/nodal_vector.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// Inertial coupling of a flexible body at one instant: the terms that the large solve treats as
/// given. It is part of the state because steps extrapolate from it.
struct Coupling {
  double t = 0;                   ///< the instant [s]
  body::DeformedMoments moments;  ///< only what is quadratic in d: J₂, J̇₂, l, l̇
  /// Nodal, n; without the centrifugal load of the undeformed body [N, N m]; empty if the level
  /// keeps none.
  linalg::NodalVector load;
};

/// Motion of a body at time t, sufficient for a bit-identical continuation.
struct BodyState {
  body::FrameMotion frame;
  Eigen::Vector3d w_dot = Eigen::Vector3d::Zero();  ///< body axes [rad/s²]
  Eigen::Vector3d v_dot = Eigen::Vector3d::Zero();  ///< world axes [m/s²]
  Eigen::Vector3d w_alg = Eigen::Vector3d::Zero();  ///< algorithmic accelerations of the frame
  Eigen::Vector3d v_alg = Eigen::Vector3d::Zero();
  linalg::NodalVector d, d_dot, d_ddot, d_alg;           ///< nodal variables, n each, body axes
  body::CouplingTerms terms;                             ///< kept by this body at present
  Coupling coupling, coupling_before, coupling_earlier;  ///< at this and the two previous steps
};

/// Memory of rows and force laws, part of the state because the next step depends on it.
struct RowMemory {
  std::vector<joints::CountedValue> coordinates;  ///< one per Model::coordinates
  linalg::Vector laws;          ///< states of force laws, from Load::first_state of each
  linalg::Vector rows;          ///< states of joint rows, from Joint::first_state of each
  std::vector<double> signals;  ///< t and the values of all signals then; empty without signals
  /// States of blocks, their rates, and rates of the time integration; SignalSet::num_states each.
  linalg::Vector blocks;
  double block_step = 0;       ///< to which the rates of the method belong [s]
  std::vector<NearPair> near;  ///< ascending
  linalg::Vector near_states;  ///< of their contacts, one after the other
  double near_time = 0;        ///< when they were found [s]
  /// In statics, where laws have no states: status of rows that hold at rest, and forces of frozen
  /// friction, one entry per Model::loads. Empty in motion.
  std::vector<loads::RowStand> at_rest;
  /// Switched off by events: one entry per Model::loads and Model::joints; empty: none.
  std::vector<char> off, released;

  bool is_off(std::size_t load) const { return !off.empty() && off[load] != 0; }
  bool is_released(std::size_t joint) const { return !released.empty() && released[joint] != 0; }
};

/// Values set from outside in place of laws of time, one entry per load of the model: components
/// of a force [N] or torque [N m] in the axes of the load. Empty: none are set.
using LoadInputs = std::vector<std::optional<Eigen::Vector3d>>;

/// Data of an earlier step for the prediction of the next one.
struct PastStep {
  double t = 0;                  ///< instant to which it refers [s]
  linalg::Vector lambda;         ///< [N, N m]; empty if nothing is known
  linalg::Vector accelerations;  ///< six per body: ẇ in body axes, v̇ in world axes
};

/// State of the mechanism.
struct State {
  double t = 0;  ///< [s]
  std::vector<BodyState> bodies;
  linalg::Vector lambda;    ///< joint multipliers [N, N m]
  double lambda_time = 0;   ///< instant to which λ refers [s]
  double last_step = 0;     ///< length of the step that led here [s]
  bool had_rounds = false;  ///< whether its inertial coupling took more than one round
  int history = 0;  ///< number of valid coupling entries and of steps without a jump: 0 … 3
  PastStep before, earlier;  ///< of the two previous steps
  LoadInputs inputs;         ///< in effect from here on
  RowMemory memory;          ///< of joint coordinates and force laws
};

/// All bodies as placed, undeformed and at rest.
State placed_state(const Model& model);

}  // namespace buckens::model
