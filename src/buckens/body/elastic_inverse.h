// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/body/sieve.h"
#include "buckens/fem/fe_model.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::body {

/// K⁺ of a free mesh: the sieved deformation under loads from which their inertia relief is taken.
///
/// K is singular by the rigid motions. Grounding as many variables as there are rigid motions,
/// isostatically, makes it positive definite without straining anything: for self-equilibrated
/// loads the grounds carry nothing. So K⁺ = Y K_g⁻¹ Yᵀ with Y the sieve.
class ElasticInverse {
 public:
  /// @param length scale that makes rotations and translations comparable [m]
  /// @throws ModelError naming the body if the mesh moves without strain other than rigidly
  ElasticInverse(const std::string& body, const fem::FeModel& fe, const Sieve& sieve,
                 double length);

  /// K⁺ f. Cost: one solve.
  linalg::Vector solve(linalg::Vector load) const;
  /// The same for each column.
  /// @throws ModelError where K K⁺f misses the sieved load: the mesh is a mechanism
  linalg::Matrix solve_checked(const linalg::Matrix& loads) const;

  /// Numbers of the held variables, as many as there are rigid motions.
  const std::vector<int>& held() const { return held_; }
  long solves() const { return solves_; }

 private:
  std::string body_;
  const fem::FeModel* fe_;
  const Sieve* sieve_;
  std::vector<int> held_;
  linalg::SparseCholesky factor_;
  mutable long solves_ = 0;
};

}  // namespace buckens::body
