// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/gap_law.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::joints {

/// The way of two bodies that touch in one place: across their surfaces, or along one of two
/// directions in them. Along them it is the rate of no position (nonholonomic): its value is zero.
class ContactWay final : public GapLaw {
 public:
  enum class Direction { across, along, other_along };
  ContactWay(const spatial::RigidTouch& touch, Direction direction)
      : touch_(touch), direction_(direction) {}

  double gap(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const override;
  spatial::PairRow derivatives(const spatial::MarkerMotion& F,
                               const spatial::MarkerMotion& M) const override;
  /// Along the surface: where it does not slip.
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M) const override;

 private:
  const Eigen::Vector3d& direction(const spatial::TouchPlace& place) const;

  spatial::RigidTouch touch_;
  Direction direction_;
};

}  // namespace buckens::joints
