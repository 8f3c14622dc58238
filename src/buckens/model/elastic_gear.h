// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/joints/gear_mesh.h"
#include "buckens/loads/force_element.h"

namespace buckens::model {

/// Two gears with elastic teeth and backlash.
///
/// The gap of a flank is measured by the row of a gear joint, eq. (R8), as if this flank carried:
/// x = ±g − j/2 along the line of action, j being the play there. Where x > 0 the flank pushes with
/// k x + c ẋ, never pulls, and its damper gives at most the force of its spring. Both flanks can
/// carry where centres come too near. States: those of the joint's
/// angles, and g
/// where the teeth are in the middle of their play: a whole number of pitches, or where they were
/// when they were switched on. Theory: docs/theory/22-rows.md §7.
class ElasticGear final : public loads::ForceElement {
 public:
  struct Data {
    double stiffness = 0;  ///< along the line of action [N/m]
    double damping = 0;    ///< the same [N s/m]
    double play = 0;       ///< j [m]
    double cosine = 1;     ///< cos β_b, from the line of action to the normal of the flanks
  };
  /// @throws ModelError if the centres coincide across the axis
  ElasticGear(const joints::GearMesh::Data& mesh, const Data& data)
      : mesh_(mesh), data_(data), axis_F_(mesh.axis_F) {}

  /// Nothing: it needs its states, see respond().
  loads::Action evaluate(double t, const spatial::MarkerMotion& first,
                         const spatial::MarkerMotion& second) const override;
  loads::Action respond(const loads::Sight& sight) const override;
  int num_soft_rows() const override { return 2; }
  void append_tangent(const loads::Sight& sight, std::vector<loads::SoftRow>& rows) const override;
  int num_states() const override { return joints::GearMesh::kStates; }
  void start_states(const loads::Sight& sight, double* states) const override;
  /// Teeth meet in the middle of their play, wherever gears have turned to.
  void restart_states(const loads::Sight& sight, double* states) const override;
  void find_states(const loads::Sight& sight, double* states) const override;

  /// Both normal to the flanks, positive where g > 0.
  struct Reading {
    double force = 0;       ///< [N]
    double deflection = 0;  ///< [m]
  };
  Reading read(const loads::Sight& sight) const;

  /// Of the gears, unit vector in the first marker.
  const Eigen::Vector3d& axis() const { return axis_F_; }

 private:
  /// One flank at one instant.
  struct Flank {
    double depth = 0;  ///< x, below zero where it does not touch [m]
    double rate = 0;   ///< ẋ [m/s]
    double viscous = 0;
    bool is_limited = false;  ///< the damper, by the spring
    spatial::PairRow J = spatial::PairRow::Zero();
    bool touches() const { return depth > 0.0; }
  };
  std::array<Flank, 2> look(const loads::Sight& sight) const;
  /// The gap g in the middle of the play that is nearest.
  double meshed_at(double g) const;

  joints::GearMesh mesh_;
  Data data_;
  Eigen::Vector3d axis_F_;
};

}  // namespace buckens::model
