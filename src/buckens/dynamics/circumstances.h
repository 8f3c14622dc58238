// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// What force laws may use besides time and motions. All of it is optional: without it, loads
/// follow their laws, joints carry nothing, and states of laws are zero.
struct Circumstances {
  const model::LoadInputs* inputs = nullptr;
  const model::RowMemory* memory = nullptr;  ///< as at the start of the step
  const linalg::Vector* lambda = nullptr;    ///< multipliers at the instant
  /// Of rigid rows at the instant, one per Load::rigid_row; null: as in the memory.
  const std::vector<loads::RowStand>* stands = nullptr;
  /// t and the values of all signals at the instant; null: as the memory has them.
  const std::vector<double>* signals = nullptr;
};

/// Those of a state.
Circumstances circumstances_of(const model::State& state);

/// Motion of a joint coordinate.
/// @param first,second motions of its markers
/// @throws NumericalError beyond 3 rad where no memory counts the turns
loads::CoordinateMotion coordinate_motion(const model::Model& model, std::size_t coordinate,
                                          const model::RowMemory* memory,
                                          const spatial::MarkerMotion& first,
                                          const spatial::MarkerMotion& second);

/// Everything a load may use.
/// @param load index into Model::loads
loads::Sight sight_of(const model::Model& model, std::size_t load, double t,
                      const Circumstances& around, const spatial::MarkerMotion& first,
                      const spatial::MarkerMotion& second);

/// The effect of one load: by its law, or by the values given for it.
/// @param load index into Model::loads
loads::Action action_of(const model::Model& model, std::size_t load, double t,
                        const Circumstances& around, const spatial::MarkerMotion& first,
                        const spatial::MarkerMotion& second);

}  // namespace buckens::dynamics
