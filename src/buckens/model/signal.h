// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/base/signal_law.h"
#include "buckens/model/control_block.h"
#include "buckens/model/marker_id.h"

namespace buckens::model {

/// A named number that varies with the motion.
struct Signal {
  enum class Kind { formula, coordinate, coordinate_rate, position, velocity, force, block };

  std::string name;
  SourceLocation where;
  Kind kind = Kind::formula;
  base::SignalLaw input;  ///< the formula itself, or what a block takes
  int coordinate = -1;    ///< index into Model::coordinates
  int load = -1;          ///< index into Model::loads
  MarkerId marker;
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< world, unit length
  std::shared_ptr<const ControlBlock> block;
  int first_state = 0;  ///< of the block among those of all

  bool is_sampled() const { return block && block->sample_time() > 0.0; }
};

/// All signals of a model.
struct SignalSet {
  /// In the order of the model file, that of the variables of formulas; then those of drives.
  std::vector<Signal> all;
  std::vector<int> order;     ///< in which they can be evaluated, one after the other
  std::vector<int> steering;  ///< those of `order` that drives depend on
  int num_states = 0;         ///< of all blocks
  double rho = 1;             ///< spectral radius of their integration at infinite frequency

  bool empty() const { return all.empty(); }
};

}  // namespace buckens::model
