// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/signal_law.h"
#include "buckens/model/control_block.h"
#include "buckens/model/marker_id.h"

namespace buckens::model {

/// A value of a sensor that follows from the motion at the same instant.
struct MotionReading {
  enum class Quantity {
    position,
    velocity,
    angular_velocity,
    relative_position,  ///< of the second marker in the axes of the first, as those below
    distance,
    relative_velocity,
    relative_rotation,
    relative_spin,
    tension,          ///< along the line between both markers of a load
    force_on_first,   ///< by a load, axes of its first marker
    torque_on_first,  ///< the opposite of that on its second marker, axes of the first
    force_on_second,  ///< by a load, axes of the world
    torque_on_second,
    normal,  ///< of an elastic contact, as those below
    friction,
    gap
  };
  Quantity quantity = Quantity::position;
  MarkerId first, second;
  std::optional<MarkerId> axes;                      ///< none: as the quantity says
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< of vectors: the component
  int load = -1;                                     ///< index into Model::loads
};

/// Value of a sensor that a signal samples at the end of every step.
struct HeldReading {
  std::string sensor;
  std::optional<std::string> component;
};

/// A named number that varies with the motion.
struct Signal {
  enum class Kind {
    formula,
    coordinate,
    coordinate_rate,
    position,
    velocity,
    force,
    reading,
    block
  };

  std::string name;
  SourceLocation where;
  Kind kind = Kind::formula;
  base::SignalLaw input;  ///< the formula itself, or what a block takes
  int coordinate = -1;    ///< index into Model::coordinates
  int load = -1;          ///< index into Model::loads
  MarkerId marker;
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< world, unit length
  std::shared_ptr<const ControlBlock> block;
  int first_state = 0;                   ///< of the block among those of all
  double factor = 1;                     ///< of forces
  std::optional<MotionReading> reading;  ///< of Kind::reading
  std::optional<HeldReading> held;       ///< of a block whose state is that of a sensor

  bool is_sampled() const { return block && block->sample_time() > 0.0; }
  /// Whether it keeps its value over a step, and takes another at its end.
  bool is_held() const { return is_sampled() || (block && block->samples_each_step()); }
};

/// All signals of a model.
struct SignalSet {
  /// In the order of the model file, which is that of the variables of formulas; then drives.
  std::vector<Signal> all;
  std::vector<int> order;     ///< in which they can be evaluated, one after the other
  std::vector<int> steering;  ///< those of `order` that drives depend on
  int num_states = 0;         ///< of all blocks
  double rho = 1;             ///< spectral radius of their integration at infinite frequency

  bool empty() const { return all.empty(); }
  /// Whether values of some are held over steps, and jump at their ends.
  bool have_samples() const {
    return std::any_of(all.begin(), all.end(), [](const Signal& one) { return one.is_held(); });
  }
  /// Whether some are read from sensors at the ends of steps; blocks are then sampled afterwards.
  bool has_held_readings() const {
    return std::any_of(all.begin(), all.end(), [](const Signal& one) { return bool(one.held); });
  }
};

}  // namespace buckens::model
