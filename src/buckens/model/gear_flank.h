// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "buckens/loads/rigid_law.h"

namespace buckens::model {

/// One flank of rigid teeth with play: a one-sided row along its own line of action, on the way
/// that is left to it (joints::FlankGap). Theory: docs/theory/22-rows.md §1.
class GearFlank final : public loads::RigidStop {
 public:
  struct Data {
    double side = 1;           ///< of the residual of the meshing row on which it pushes
    double play = 0;           ///< j, along the line of action [m]
    double period = 1;         ///< along it, after which spaces between teeth repeat [m]
    double pitch_cosine = 1;   ///< cos α_t, from the pitch circle to the line of action
    double normal_cosine = 1;  ///< cos β_b, from the line of action to the normal of the flanks
    Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();  ///< of the gears, in the first marker
  };
  GearFlank(const Data& data, double restitution, double threshold)
      : RigidStop(0.0, HUGE_VAL, restitution, threshold), data_(data) {}

  const Data& data() const { return data_; }
  /// Its force normal to the flanks, positive where it pushes on its side [N].
  double signed_force(double along_gap) const {
    return data_.side * along_gap / data_.normal_cosine;
  }
  /// How far teeth are from the middle of their play, on the pitch circle and positive on the side
  /// of this flank [m]. @param gap of this flank [m]
  double passed(double gap) const {
    return data_.side * (0.5 * data_.play - gap) / data_.pitch_cosine;
  }

 private:
  Data data_;
};

}  // namespace buckens::model
