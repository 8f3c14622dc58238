// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::body {

class NodalMotion;

/// Removes rigid-body motion from the nodal variables of one flexible body.
///
/// The Buckens frame demands Pᵀd = 0 with P = MΦ, FM (25), (26). Adding a rigid motion to d changes
/// no strain, so the condition is met by the projection
///
///     Y d = d − Φ S⁻¹ (Pᵀ d),   S = ΦᵀMΦ                                FM (38), (39)
///
/// instead of the multiplier term PΛ. Loads are sieved by Yᵀ. Y is idempotent and self-adjoint in
/// the M-product; it is full, so it is never formed: 24 n flops per application.
///
/// S is handled by its rank: Φ is replaced by an M-orthonormal basis of the motions that carry
/// mass, so that S becomes the identity. Large solids form it and its image from the positions of
/// their nodes (NodalMotion) and store neither.
class Sieve {
 public:
  /// @param Phi rigid modes, n×6, zero columns allowed
  /// @param M mass matrix, n×n
  Sieve(const linalg::Matrix& Phi, const linalg::SymmetricMatrix& M);
  /// Drops the columns that are stored, in favour of what they follow from.
  void keep_by_node(std::shared_ptr<const NodalMotion> motion);

  /// d ← Y d.
  void apply(linalg::Vector& d) const;
  /// Sieves each column.
  void apply(linalg::Matrix& columns) const;
  /// f ← Yᵀ f for loads.
  void apply_transposed(linalg::Vector& f) const;
  void apply_transposed(linalg::Matrix& loads) const;

  /// Rigid motion left in d: S⁻¹Pᵀd, three translations [m] and three rotations [rad].
  Eigen::Matrix<double, 6, 1> rigid_part(const linalg::Vector& d) const;

  /// Number of rigid motions with mass, at most six.
  Eigen::Index rank() const { return to_axes_.cols(); }
  const Eigen::Matrix<double, 6, 6>& S() const { return S_; }
  /// From amplitudes of the orthonormal modes to three translations and three rotations, 6×rank.
  const linalg::Matrix& to_axes() const { return to_axes_; }
  /// M-orthonormal rigid modes and their images P = MΦ, n×rank; copied or formed on each call.
  linalg::Matrix Phi() const;
  linalg::Matrix P() const;
  /// The same where they are stored, else empty.
  const linalg::Matrix& stored_Phi() const { return Phi_; }
  const linalg::Matrix& stored_P() const { return P_; }

 private:
  Eigen::Matrix<double, 6, 6> S_;
  linalg::Matrix to_axes_;
  linalg::Matrix Phi_, P_;
  std::shared_ptr<const NodalMotion> by_node_;  // in place of them, or null
};

}  // namespace buckens::body
