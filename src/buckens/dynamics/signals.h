// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/LU>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// All signals of a model at one instant, and scratch.
struct SignalValues {
  std::vector<double> values;  ///< t, then one per signal
  linalg::Vector x, x_dot;     ///< states of all blocks and their rates
  linalg::Vector fixed, open, rates, known, method_rates, right;
  Eigen::MatrixXd tangent;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor;
};

/// What one joint coordinate is taken to be more than it is: for tangents.
struct CoordinateShift {
  int coordinate = -1;
  double value = 0;  ///< [rad] or [m]
  double rate = 0;   ///< [rad/s] or [m/s]
};

/// Evaluates all signals. States of blocks go from the instant of the memory to t by the
/// first-order generalised-α method, implicitly, so that what they say belongs to t. Theory:
/// docs/theory/24-control.md §3.
/// @param around with the memory at the start of the step; without one blocks are as at t = 0
/// @throws NumericalError naming the signal whose states do not settle
void evaluate_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const Circumstances& around, SignalValues& out,
                      const CoordinateShift& shift = {});

/// The same circumstances with the values of all signals, unless they have them. Laws of force that
/// follow signals need them, in statics and before the first step, too.
/// @param values what the result points to, where the model has signals
Circumstances with_signals(const model::Model& model, const std::vector<BodyMotion>& motions,
                           double t, const Circumstances& given, SignalValues& values);

/// A state of a block and the value it is given.
struct StateChange {
  int state = 0;  ///< among those of all blocks
  double value = 0;
};

/// Fills the share of signals in a memory that begins, samples at t = 0 taken.
/// @param changes values that states of blocks have in place of those they start with
void start_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                   model::RowMemory& memory, const std::vector<StateChange>& changes = {});

enum class Samples { are_taken, are_due };

/// Gives states of blocks other values at the instant of the memory; all signals follow.
/// @param samples whether those of this instant are still to be taken, with these values
void change_states(const model::Model& model, const std::vector<BodyMotion>& motions,
                   const Circumstances& around, const std::vector<StateChange>& changes,
                   model::RowMemory& memory, Samples samples = Samples::are_taken);

/// Writes the share of signals in the memory at the end of a step, samples at its end taken unless
/// SignalSet::has_held_readings(): these come first, by change_states().
/// @param around with the memory at its start
void advance_signals(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     const Circumstances& around, model::RowMemory& out);

}  // namespace buckens::dynamics
