// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/body/coupling_level.h"
#include "buckens/fem/fe_model.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::body {

class NodalMotion;

/// The 3×3 moments of a deformed body that couple its frame and nodal variables.
///
/// T_ab(x, y) = xᵀ W_ab y with W_ab = ∫ g_a g_bᵀ dm. Everything is in body axes.
struct DeformedMoments {
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();      ///< rotary inertia [kg m²]
  Eigen::Matrix3d J_dot = Eigen::Matrix3d::Zero();  ///< its rate [kg m²/s]
  Eigen::Vector3d l = Eigen::Vector3d::Zero();      ///< relative angular momentum [N m s], FM (11)
  Eigen::Vector3d l_dot = Eigen::Vector3d::Zero();  ///< Cᵀd̈ [N m]
};

/// Inertia integrals of a finite-element body and derived quantities.
///
/// With C(d) = ∫ s sᵀ dm = C₀ + S₁ + S₁ᵀ + S₂ and S₁_ab = c_ab·d, S₂_ab = dᵀW_ab d,
/// J(d) = J₀ + tr(ΔC) 1 − ΔC, ΔC = C(d) − C₀;  l_a = dᵀH_a ḋ with H_1 = W_23 − W_32 and cyclic.
/// FM (11), (15), (18), (53), (55).
class InertiaInvariants {
 public:
  explicit InertiaInvariants(const fem::ShapeIntegrals& shape);
  /// Drops the columns that are stored, in favour of what they follow from; `shape` need not have
  /// its columns c any longer.
  void keep_by_node(std::shared_ptr<const NodalMotion> motion);

  /// Rotary inertia of the deformed body [kg m²]. Cost: six sparse products; for solids one with
  /// the scalar mass matrix (also below).
  Eigen::Matrix3d rotary_inertia(const linalg::Vector& d) const;

  /// l = Σ dᵀH_a ḋ e_a [N m s].
  Eigen::Vector3d relative_momentum(const linalg::Vector& d, const linalg::Vector& d_dot) const;

  /// All moments at once. Cost: nine sparse products.
  DeformedMoments moments(const linalg::Vector& d, const linalg::Vector& d_dot,
                          const linalg::Vector& d_ddot) const;

  /// Only the parts quadratic in d: J₂, J̇₂, l and l̇.
  DeformedMoments quadratic_moments(const linalg::Vector& d, const linalg::Vector& d_dot,
                                    const linalg::Vector& d_ddot) const;

  /// J₁, the part of J linear in d, from six numbers.
  /// @param z pattern_values(d); with ḋ instead of d the result is J̇₁
  static Eigen::Matrix3d linear_inertia(const Eigen::Matrix<double, 6, 1>& z);

  /// y ← y + Σ_ab A_ab W_ab x.
  void add_weighted(const Eigen::Matrix3d& A, const linalg::Vector& x, linalg::Vector& y) const;

  /// Nodal inertia loads that depend on the deformation, FM (22)–(24) without ĉ:
  /// Σ (|w|²δ − w w)_ab W_ab d + 2 Σ w_a H_a ḋ + Σ ẇ_a H_a d. @param kept which of the three
  linalg::Vector deformation_load(const linalg::Vector& d, const linalg::Vector& d_dot,
                                  const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot,
                                  const CouplingTerms& kept = {}) const;

  /// Centrifugal load patterns of the undeformed body, n×6: columns for the weights returned by
  /// centrifugal_weights(), FM (24). Copied or formed on each call.
  linalg::Matrix centrifugal_patterns() const;
  /// The same where they are stored, else empty.
  const linalg::Matrix& stored_patterns() const { return patterns_; }
  /// Products of these columns with d, c_ab·d.
  Eigen::Matrix<double, 6, 1> pattern_values(const Eigen::Ref<const linalg::Vector>& d) const;
  /// Adds the sum of these columns with weights. Allocates nothing.
  void add_centrifugal_load(const Eigen::Matrix<double, 6, 1>& weights, linalg::Vector& load) const;
  /// The columns c_ab of fem::ShapeIntegrals, n×9; copied or formed on each call.
  linalg::Matrix first_moments() const;
  /// (|w|²δ − w w) as (11, 22, 33, 12, 13, 23) [rad²/s²].
  static Eigen::Matrix<double, 6, 1> centrifugal_weights(const Eigen::Vector3d& w);

 private:
  const fem::ShapeIntegrals* shape_;
  linalg::Matrix patterns_;
  std::shared_ptr<const NodalMotion> by_node_;  // in place of them, or null
};

}  // namespace buckens::body
