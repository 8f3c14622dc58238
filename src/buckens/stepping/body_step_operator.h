// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// Everything of one flexible body that a step of fixed length needs: one factorisation of
/// K̂ = m M + c C + k K, and the answers to unit interface loads computed from it once.
///
/// Per step it performs one solve; interface forces cost a thin product only, FM (37)–(42).
/// All columns are sieved.
class BodyStepOperator {
 public:
  BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme);

  /// x⁺ without interface and centrifugal loads: Y K̂⁻¹ [ … ], one large solve.
  /// @param load nodal load at the evaluation instant, n
  void free_response(const model::BodyState& before, const History<linalg::Vector>& history,
                     const linalg::Vector& load, linalg::Vector& free);

  /// x⁺ ← free + c G f + c G_c a + D e.
  void complete(const linalg::Vector& interface_load,
                const Eigen::Matrix<double, 6, 1>& centrifugal, const linalg::Vector& correction,
                linalg::Vector& x) const;
  /// G e: the position correction itself, which carries no velocity.
  linalg::Vector correction(const linalg::Vector& e) const { return G_ * e; }

  /// N G: interface values per interface load, before the factor c.
  const linalg::Matrix& compliance() const { return NG_; }
  /// N D: change of the total interface values per correction load.
  const linalg::Matrix& correction_compliance() const { return ND_; }
  /// N G_c: interface values per centrifugal weight, before the factor c.
  const linalg::Matrix& centrifugal_compliance() const { return NGc_; }
  /// First `num_interface_rows` rows of N.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& N() const { return N_; }

  const linalg::SparseMatrix& K_hat() const { return K_hat_; }
  double factor_entries() const { return factor_.num_factor_entries(); }
  long solves() const { return solves_; }
  long setup_solves() const { return setup_solves_; }

 private:
  const body::FlexiblePart* part_;
  Scheme scheme_;
  linalg::SparseMatrix K_hat_;
  linalg::SparseCholesky factor_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> N_;
  linalg::Matrix G_;   // Y K̂⁻¹ Nᵀ
  linalg::Matrix D_;   // effect of a correction on x⁺
  linalg::Matrix Gc_;  // Y K̂⁻¹ of the centrifugal patterns
  linalg::Matrix NG_, ND_, NGc_;
  linalg::Vector right_side_, scratch_;
  long solves_ = 0, setup_solves_ = 0;
};

}  // namespace buckens::stepping
