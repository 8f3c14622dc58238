// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/time_law.h"
#include "buckens/loads/force_element.h"

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
               const Eigen::Vector3d& torque_B);

  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  bool is_applied() const override { return true; }
  bool is_constant() const override { return value_.is_constant(); }
  int num_values() const override { return 1; }
  Eigen::Vector3d values(double t) const override { return {value_.value(t), 0.0, 0.0}; }
  bool follows() const override { return true; }

 private:
  base::TimeLaw value_;
  double area_;
  Eigen::Vector3d force_B_, torque_B_;
};

}  // namespace buckens::loads
