// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/linalg/node_kernels.h"

namespace buckens::body {

/// Rigid motions and centrifugal patterns of a solid, formed node by node from its coordinates.
///
/// Of a solid of isoparametric elements without constraints, with node positions X from the mass
/// centre, scalar masses m_j = Σ_i Ms_ji and first moments s_j = Σ_i Ms_ji X_i,
///
///     Φ_j (t, r) = t + r × X_j,   Pᵀx = (Σ m_j x_j, Σ s_j × x_j),   c_ab·x = Σ s_ja x_jb:
///
/// four numbers per node instead of the eighteen of each of Φ, P and the patterns. It also holds a
/// copy of Ms, so that variants of a model can read one instead of one each.
class NodalMotion {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// Empty if the body is something else; Φ, P and the patterns that it has are compared.
  static std::shared_ptr<const NodalMotion> of(const FlexiblePart& part);
  /// Whether both are bitwise the same.
  bool operator==(const NodalMotion& other) const;

  /// The scalar mass matrix, as long as this object lives.
  linalg::NodeMatrix mass() const;

  /// y = M x at some variables, whole nodes, of a body whose M is the scalar mass matrix.
  void multiply_mass(Eigen::Index first, Eigen::Index size, const linalg::Vector& x,
                     linalg::Vector& y) const;

  /// Adds what rigid() and patterns() need of some variables of x, whole nodes.
  void add_moments(Eigen::Index first, Eigen::Index size, const linalg::Vector& x,
                   linalg::NodeSums& sums) const;
  /// Pᵀx of the orthonormal motions of the sieve.
  Vector6 rigid(const linalg::NodeSums& sums) const;
  /// c_ab·x in the order of InertiaInvariants::centrifugal_patterns().
  static Vector6 patterns(const linalg::NodeSums& sums);

  /// T with Φ_j a = T (X_j, 1), columns of four numbers. @param rigid amplitudes a of the sieve
  Eigen::Matrix4d motion(const Vector6& rigid) const;
  /// y −= Φ a at some variables, whole nodes.
  void subtract(Eigen::Index first, Eigen::Index size, const Eigen::Matrix4d& motion,
                linalg::Vector& y) const;

 private:
  explicit NodalMotion(const FlexiblePart& part);
  bool describes(const FlexiblePart& part) const;

  const linalg::NodeKernels* kernels_;
  std::vector<double> values_;      // of Ms
  std::vector<int> rows_, begin_;   // the same
  Eigen::Matrix4Xd positions_;      // X, 1
  Eigen::Matrix4Xd first_moments_;  // s, m
  /// From amplitudes of the orthonormal motions to translations and rotations.
  Eigen::Matrix<double, 6, 6> to_axes_;
};

}  // namespace buckens::body
