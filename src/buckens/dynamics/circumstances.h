// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

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

/// t and the values of all signals; empty where nothing says them.
inline std::span<const double> signals_of(const Circumstances& around) {
  if (around.signals != nullptr) return *around.signals;
  if (around.memory != nullptr) return around.memory->signals;
  return {};
}

/// Gravity [m/s²], world: the model's until an event changes it.
/// @param signals t and the values of all signals; empty: the model's
inline Eigen::Vector3d gravity_at(const model::Model& model, std::span<const double> signals) {
  if (model.gravity_settings < 0 || signals.empty()) return model.gravity;
  return Eigen::Map<const Eigen::Vector3d>(signals.data() + 1 + model.gravity_settings);
}

/// Whether a load is a row of a place of a rigid contact that is open, so that it does nothing,
/// wherever its bodies are. @param load index into Model::loads
bool is_open_place(const model::Model& model, std::size_t load, const Circumstances& around);

/// Those of a state.
Circumstances circumstances_of(const model::State& state);

/// What the rows of a joint remember; null where nothing is known, or nothing remembered.
inline const double* states_of(const model::Joint& joint, const model::RowMemory* memory) {
  return memory == nullptr || memory->rows.size() == 0 ? nullptr
                                                       : memory->rows.data() + joint.first_state;
}

/// Where a joint coordinate was a step before; null where no memory says so.
inline const joints::CountedValue* before_of(const model::RowMemory* memory,
                                             std::size_t coordinate) {
  return memory == nullptr || memory->coordinates.empty() ? nullptr
                                                          : &memory->coordinates[coordinate];
}

/// Value of a joint coordinate with its turns.
/// @param t of these motions, @param first,second motions of its markers
/// @throws NumericalError beyond 3 rad where no memory counts the turns
joints::CountedValue counted_coordinate(const model::Model& model, std::size_t coordinate, double t,
                                        const model::RowMemory* memory,
                                        const spatial::MarkerMotion& first,
                                        const spatial::MarkerMotion& second);

/// Motion of a joint coordinate.
/// @param t of these motions, @param first,second motions of its markers, @param now null, or its
/// value with its turns
/// @throws NumericalError beyond 3 rad where no memory counts the turns
loads::CoordinateMotion coordinate_motion(const model::Model& model, std::size_t coordinate,
                                          double t, const model::RowMemory* memory,
                                          const spatial::MarkerMotion& first,
                                          const spatial::MarkerMotion& second,
                                          joints::CountedValue* now = nullptr);

/// What a joint between two markers does to them, see SummedCoordinate for couplers.
/// @param first,second motions of these markers
struct JointWrenches {
  spatial::Wrench on_first, on_second;
};
JointWrenches wrenches_of(const model::Joint& joint, double t, const model::RowMemory* memory,
                          const linalg::Vector& lambda, const spatial::MarkerMotion& first,
                          const spatial::MarkerMotion& second);

class Travel;

/// All that a load may see.
/// @param load index into Model::loads, @param travel of a law on a slider's coordinate
loads::Sight sight_of(const model::Model& model, std::size_t load, double t,
                      const Circumstances& around, const spatial::MarkerMotion& first,
                      const spatial::MarkerMotion& second, const Travel* travel = nullptr);

/// The same for a law on a joint whose reaction on the second marker is known.
/// @param now null, or the value of its coordinate, if it has one
loads::Sight sight_at_joint(const model::Model& model, std::size_t load, double t,
                            const Circumstances& around, const spatial::MarkerMotion& first,
                            const spatial::MarkerMotion& second, const spatial::Wrench& reaction,
                            joints::CountedValue* now = nullptr);

/// The effect of one load: by its law, or by the values given for it.
/// @param load index into Model::loads, @param travel of a law on a slider's coordinate
loads::Action action_of(const model::Model& model, std::size_t load, double t,
                        const Circumstances& around, const spatial::MarkerMotion& first,
                        const spatial::MarkerMotion& second, const Travel* travel = nullptr);

}  // namespace buckens::dynamics
