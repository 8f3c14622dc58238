// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/body/sieve.h"
#include "buckens/fem/fe_model.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::body {

/// K_g − K, where K_g is K with the rows and columns of the held variables replaced by those of a
/// diagonal matrix. Reads nothing of K but its diagonal and products, as other processes may have
/// it. @param held ascending
linalg::SparseMatrix grounding(const linalg::SymmetricMatrix& K, const std::vector<int>& held);

/// K⁺ of a free mesh: the sieved deformation under loads with inertia relief.
///
/// K is singular by the rigid modes Φ. With exactly rank(Φ) variables held (isostatic grounding)
/// the rest, K_ff, is positive definite, and
///
///     K⁺ = Y K_g⁻¹ Yᵀ,      K_g⁻¹ = [K_ff⁻¹ 0; 0 0]                        FM (38), (39)
///
/// does not depend on which variables are held: sieved loads cause no reaction there, and the sieve
/// removes the rigid motion that holding them introduces. K K⁺ f = Yᵀ f, Pᵀ K⁺ f = 0. Theory:
/// docs/theory/06-initial-state.md §3.
class ElasticInverse {
 public:
  /// @param length scale that makes rotations and translations comparable [m]
  /// @throws ModelError naming the body if the mesh has strain-free motions other than rigid ones
  /// @param make factorises K_g, or makes what takes the place of a factor
  ElasticInverse(const std::string& body, const fem::FeModel& fe, const Sieve& sieve, double length,
                 const linalg::MakeFactor& make = linalg::make_cholesky);

  /// K⁺ f. Cost: one solve.
  linalg::Vector solve(linalg::Vector load) const;
  /// The same for each column.
  /// @throws ModelError where K K⁺f misses the sieved load: the mesh is a mechanism
  linalg::Matrix solve_checked(const linalg::Matrix& loads) const;

  /// Indices of the held variables, as many as there are rigid motions.
  const std::vector<int>& held() const { return held_; }
  long solves() const { return solves_; }

 private:
  std::string body_;
  const fem::FeModel* fe_;
  const Sieve* sieve_;
  std::vector<int> held_;
  std::shared_ptr<const linalg::Factor> factor_;
  mutable long solves_ = 0;
};

}  // namespace buckens::body
