// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/time_law.h"
#include "buckens/loads/force_element.h"
#include "buckens/loads/signal_factor.h"

namespace buckens::loads {

/// Pressure on faces of a mesh, along their undeformed normals in body axes.
///
/// The nodal forces are −p ∫ N n dA. Their resultant acts on the body frame; on the mesh they act
/// along one row, w·d = −(1/A) ∫ n·u dA, with the load p A, eq. (L2). Normals and lever arms both
/// belong to the undeformed faces: so pressure all around a body has no resultant, however it is
/// deformed.
///
/// The first marker is the frame of the body, its origin at the mass centre.
class PressureLoad final : public ForceElement {
 public:
  /// @param value law of time [Pa]
  /// @param area A [m²]
  /// @param force_B −∫ n dA [m²], body axes
  /// @param torque_B −∫ x × n dA about the mass centre [m³], body axes
  PressureLoad(base::TimeLaw value, double area, const Eigen::Vector3d& force_B,
               const Eigen::Vector3d& torque_B, SignalFactor factor = SignalFactor());

  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  bool uses_signals() const override { return factor_.exists(); }
  bool is_applied() const override { return true; }
  bool is_constant() const override { return !factor_.exists() && value_.is_constant(); }
  int num_values() const override { return factor_.exists() ? 0 : 1; }
  Eigen::Vector3d values(double t) const override { return {value_.value(t), 0.0, 0.0}; }
  bool follows() const override { return true; }

 private:
  Action press(double p, const spatial::MarkerMotion& first) const;

  base::TimeLaw value_;
  double area_;
  Eigen::Vector3d force_B_, torque_B_;
  SignalFactor factor_;
};

}  // namespace buckens::loads
