// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/fe_model.h"

namespace buckens::fem {

/// Stiffening of beams and bars by their axial force.
///
/// An element with axial force N resists rotation: f = −N G d with its geometric stiffness N G
/// (cubic deflection for beams, linear for bars). N follows from d itself, N = EA/l · t·(u₂ − u₁),
/// whatever its cause: centrifugal load, joint forces, axial vibration. The force is quadratic in d
/// and goes to the right-hand side; K stays constant. Rigid rotation is not free of this force; the
/// sieve removes that part.
class GeometricStiffness {
 public:
  explicit GeometricStiffness(const FeModel& fe);

  /// −Σ N(d) G d over the elements [N, N m].
  linalg::Vector load(const linalg::Vector& d) const;
  /// Axial force of each line element [N], tension positive.
  linalg::Vector axial_forces(const linalg::Vector& d) const;
  /// Σ N_e G_e for given axial forces, n×n.
  linalg::SparseMatrix matrix(const linalg::Vector& axial_forces) const;

 private:
  struct Element {
    std::array<int, 12> dofs;  ///< −1: not present
    Eigen::Vector3d axial;     ///< EA/l · t [N/m]
    Eigen::Matrix<double, 12, 12> G;
  };

  double axial_force(const Element& element, const linalg::Vector& d) const;

  Eigen::Index size_;
  std::vector<Element> elements_;
};

}  // namespace buckens::fem
