// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/body/body.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::analysis {

/// Static response of a free flexible body, d = K⁺ f, the rigid motion left to its frame.
///
/// K is singular by the rigid modes Φ. With exactly rank(Φ) variables held (isostatic grounding)
/// the rest, K_ff, is positive definite, and
///
///     K⁺ = Y K_g⁻¹ Yᵀ,      K_g⁻¹ = [K_ff⁻¹ 0; 0 0]                        FM (38), (39)
///
/// does not depend on which variables are held: sieved loads need no reaction there, and the sieve
/// takes out the rigid motion that holding them brings in. K K⁺ f = Yᵀ f, Pᵀ K⁺ f = 0.
///
/// One sparse Cholesky factor of its own, one solve per interface row; both apart from those of the
/// time steps. Theory: docs/theory/06-initial-state.md §3.
class ElasticCompliance {
 public:
  /// @param body a flexible body that outlives this object
  /// @throws ModelError if the mesh can move without strain other than as a rigid body
  explicit ElasticCompliance(const body::Body& body);

  /// K⁺ f for a nodal load f.
  linalg::Vector solve(linalg::Vector load) const;

  /// K⁺ Nᵀ, one column per interface row, n×rows [m/N, rad/N, …].
  const linalg::Matrix& columns() const { return columns_; }
  /// N K⁺ Nᵀ: interface values per interface load; symmetric, positive semidefinite.
  const linalg::Matrix& interface() const { return interface_; }
  /// Numbers of the held variables, as many as there are rigid motions.
  const std::vector<int>& held() const { return held_; }
  /// Large solves so far, those of the columns included.
  long num_solves() const { return solves_; }

 private:
  const body::FlexiblePart* part_;
  std::vector<int> held_;
  linalg::SparseCholesky factor_;
  linalg::Matrix columns_, interface_;
  mutable long solves_ = 0;
};

}  // namespace buckens::analysis
