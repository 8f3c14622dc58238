// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

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
/// four numbers per node instead of the eighteen of each of Φ, P and the patterns. It holds Ms,
/// too, so that variants of a model can read one instead of one each.
class NodalMotion {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Input = Eigen::Ref<const linalg::Vector>;
  using InPlace = Eigen::Ref<linalg::Vector>;
  /// Bodies with fewer variables keep matrices: theirs are multiplied as a whole.
  static constexpr Eigen::Index kFewestVariables = 25;

  /// Empty if the body is something else; Φ, P and the first moments that it has are compared.
  static std::shared_ptr<const NodalMotion> of(const FlexiblePart& part);
  /// Whether both are bitwise the same.
  bool operator==(const NodalMotion& other) const;

  /// The scalar mass matrix, as long as this object lives and nobody lets go of it.
  linalg::NodeMatrix mass() const;
  const linalg::SharedMatrix& scalar_mass() const { return Ms_; }
  /// (X, 1) and (s, m) of the nodes.
  const Eigen::Matrix4Xd& positions() const { return positions_; }
  const Eigen::Matrix4Xd& mass_moments() const { return first_moments_; }

  /// Pᵀx, amplitudes of the orthonormal motions of the sieve.
  Vector6 momenta(const Input& x) const { return rigid(moments(x)); }
  /// Φᵀf of loads.
  Vector6 resultants(const Input& f) const;
  /// x −= Φ a.
  void subtract_motion(const Vector6& a, InPlace x) const;
  /// f −= P a.
  void subtract_load(const Vector6& a, InPlace f) const;
  /// What rigid() and patterns() need of all variables.
  linalg::NodeSums moments(const Input& x) const;
  /// f += Σ weight × c_ab.
  void add_pattern_load(const Vector6& weights, InPlace f) const;
  /// The columns themselves: Φ, P and c_ab, n×6 each, and ∫ s0_a g_b dm, n×9.
  linalg::Matrix Phi() const;
  linalg::Matrix P() const;
  linalg::Matrix patterns() const;
  linalg::Matrix first_moments() const;

  /// y = M x at some variables, whole nodes, of a body whose M is the scalar mass matrix.
  void multiply_mass(Eigen::Index first, Eigen::Index size, const linalg::Vector& x,
                     linalg::Vector& y) const;

  /// Adds what rigid() and patterns() need of some variables of x, whole nodes.
  void add_moments(Eigen::Index first, Eigen::Index size, const linalg::Vector& x,
                   linalg::NodeSums& sums) const;
  /// Pᵀx.
  Vector6 rigid(const linalg::NodeSums& sums) const;
  /// c_ab·x in the order of the columns patterns().
  static Vector6 patterns(const linalg::NodeSums& sums);

  /// T with Σ weight × c_ab = −T (s_j, m_j) at each node.
  static Eigen::Matrix4d pattern_motion(const Vector6& weights);
  /// T with Φ_j a = T (X_j, 1), columns of four numbers. @param rigid amplitudes a of the sieve
  Eigen::Matrix4d motion(const Vector6& rigid) const;
  /// y −= Φ a at some variables, whole nodes.
  void subtract(Eigen::Index first, Eigen::Index size, const Eigen::Matrix4d& motion,
                linalg::Vector& y) const;

 private:
  explicit NodalMotion(const FlexiblePart& part);
  bool describes(const FlexiblePart& part) const;

  Eigen::Index num_dofs() const { return 3 * positions_.cols(); }
  linalg::Matrix columns(const Eigen::Matrix4Xd& places) const;

  const linalg::NodeKernels* kernels_;
  linalg::SharedMatrix Ms_;
  Eigen::Matrix4Xd positions_;           // X, 1
  Eigen::Matrix4Xd first_moments_;       // s, m
  Eigen::Matrix<double, 6, 6> to_axes_;  // as of the sieve
};

}  // namespace buckens::body
