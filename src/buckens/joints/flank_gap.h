// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "buckens/joints/coordinate_measure.h"
#include "buckens/joints/gear_mesh.h"

namespace buckens::joints {

/// The way that is left to one flank of rigid teeth with play, along its line of action,
///
///     x = j/2 ∓ g(s = ∓1) + k p                                                            (R41)
///
/// with the residual g of the meshing row, (R8) or (R9), as if this flank carried. Whole turns are
/// not counted: g repeats with every pitch p, and k is that of the nearest space between teeth, or
/// of the space in which the flank was a step before.
class FlankGap final : public CoordinateMeasure {
 public:
  struct Data {
    std::shared_ptr<const RowLaw> mesh;  ///< its last state is the flank that carries
    double period = 1;                   ///< p [m]
    double play = 0;                     ///< j [m]
    double side = 1;                     ///< of g, on which this flank pushes: 1 or −1
  };
  explicit FlankGap(const Data& data) : data_(data) {}

  bool is_angle() const override { return false; }
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

 private:
  static constexpr std::size_t kMostStates = GearMesh::kStates;
  /// Of the row: nothing is known but that this flank carries.
  std::array<double, kMostStates> states() const;

  Data data_;
};

}  // namespace buckens::joints
