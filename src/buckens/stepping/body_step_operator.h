// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/body/body.h"
#include "buckens/linalg/common_table.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/solve_exchange.h"
#include "buckens/stepping/body_answer.h"
#include "buckens/stepping/body_responses.h"
#include "buckens/stepping/divided_body.h"
#include "buckens/stepping/inertial_load.h"

namespace buckens::stepping {

class BodyStepOperator;

/// Possible sources of the factor of a step matrix.
struct FactorSource {
  /// A body that may have bitwise the same matrices; both then share its factor.
  const BodyStepOperator* twin = nullptr;
  /// Exchange through which other simulations may have the factor; null: none.
  linalg::SolveExchange* exchange = nullptr;
  /// Makes the factor if nobody has it; empty: linalg::make_large_factor().
  linalg::MakeFactor make{};
  /// See StepSettings::vectors.
  linalg::SharedStore* vectors = nullptr;
};

/// Everything a step of fixed length needs of one flexible body: one factorisation of K̂ = m M + c
/// C + k K, and the responses to unit interface loads computed from it once.
///
/// The rows N are those of the interface and, unless the coupling keeps nothing at all, the six
/// patterns c_ab: their values c_ab·d make up J₁, and loads along them are the centrifugal load of
/// the undeformed body.
///
/// A step is one solve; interface forces cost a thin product only, FM (37)–(42). LargeStep says
/// what is solved. All columns are sieved. Bodies of at most 24 variables, such as the parts of a
/// divided beam, multiply by a dense inverse instead of the sparse solve; reduced bodies, whose K̂
/// is diagonal, divide.
class BodyStepOperator final : public BodyAnswer {
 public:
  BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme,
                   const FactorSource& source = {});
  /// Whether a body has the same step matrix as this one.
  bool fits(const body::FlexiblePart& part) const;
  /// Whether it can stand for another body: one with few variables that has bitwise the same
  /// matrices, rows and rigid modes. The parts of a divided beam then read one operator, which
  /// stays in the cache, instead of thousands that are equal.
  bool serves(const body::FlexiblePart& part) const;

  /// x ← K̂⁻¹ x; small bodies sieve the result, others leave that to the caller. Several threads may
  /// solve for small bodies at once.
  void solve_right_side(linalg::Vector& x, TaskPool* pool = nullptr);
  /// The factor that several bodies may share; empty if the solve needs none.
  const linalg::Factor* shared_factor() const {
    return inverse_.size() > 0 || is_diagonal() ? nullptr : factor_.get();
  }

  /// x ← Y K̂⁻¹ x, outside of steps: counts as set-up.
  void solve(linalg::Vector& x, TaskPool* pool = nullptr);

  /// Adds c G f, the response to loads along the rows of N, to a piece of a vector. This and the
  /// next two: of bodies whose responses are here, not divided().
  /// @param load f, including weights of the patterns
  /// @param first first row of the piece
  void add_answer(const Eigen::VectorXd& load, Eigen::Index first,
                  Eigen::Ref<linalg::Vector> piece) const;
  /// Adds G e, the position correction by the load e, which carries no velocity.
  void add_correction(const Eigen::VectorXd& e, Eigen::Index first,
                      Eigen::Ref<linalg::Vector> piece) const;
  /// Adds (D − G) e, the effect of the strain of the correction on the motion of the step.
  void add_correction_answer(const Eigen::VectorXd& e, Eigen::Index first,
                             Eigen::Ref<linalg::Vector> piece) const;

  /// In one pass over N.
  void row_values(const model::BodyState& state, linalg::Vector& y, linalg::Vector& y_dot,
                  linalg::Vector& y_ddot, linalg::Vector& y_alg,
                  TaskPool* pool = nullptr) const override;
  /// N Φ: values of the rigid motions that carry mass, orthonormal.
  const linalg::Matrix& rigid_row_values() const { return rigid_row_values_; }
  /// N X, of the interface, then of the six patterns. @param X n rows
  linalg::Matrix row_values(const Eigen::Ref<const linalg::Matrix>& X) const;
  /// Nᵀ, n rows.
  linalg::Matrix loads_along_rows() const;
  /// Those rows of N that belong to the interface; the others are the patterns.
  const InterfaceRows& interface_rows() const { return N_; }

  /// G = Y K̂⁻¹ Nᵀ; empty if other processes have it.
  const linalg::Matrix& responses() const { return responses_->G; }

  /// Whether N has rows of the patterns.
  bool has_patterns() const { return has_patterns_; }
  /// The vectors c_ab as columns where they are stored: not of nodal().
  const linalg::Matrix& stored_patterns() const { return part_->invariants.stored_patterns(); }
  Eigen::Index num_dofs() const { return part_->num_dofs(); }
  const body::Sieve& sieve() const { return part_->sieve; }
  /// Rigid motion and patterns node by node, of large solids without constraints; else null.
  const body::NodalMotion* nodal() const { return nodal_.get(); }
  /// Null, or what other processes have of the body, who then work on the rows of its vectors.
  const DividedBody* divided() const { return divided_.get(); }
  /// What passes over the rows read that other bodies may read, too; nothing of a divided() body.
  const linalg::CommonTable& common() const { return common_; }

  /// Formed on each call: a step only needs its factor and its diagonal.
  linalg::SparseMatrix K_hat() const;
  const linalg::Vector& K_hat_diagonal() const { return diagonal_; }
  const InertialLoad& inertial() const { return inertial_; }
  bool is_diagonal() const { return diagonal_inverse_.size() > 0; }
  /// Why bodies whose solver is chosen automatically have theirs; empty for others.
  const std::string& why_solver() const { return why_solver_; }
  bool iterates() const { return factor_ && factor_->iterates(); }
  double factor_entries() const { return factor_ ? factor_->num_factor_entries() : 0.0; }
  /// Bytes that each of the two passes of a solve reads; 0 if the factor is that of a twin.
  double factor_bytes() const { return factor_ && !is_shared_ ? factor_->bytes() : 0.0; }
  /// 1, or 0 if the factor is that of a twin or of another simulation, K̂ is diagonal, or solves
  /// iterate.
  long factorisations() const { return is_shared_ || is_diagonal() || iterates() ? 0 : 1; }
  long setup_solves() const { return setup_solves_; }

 private:
  void find_factor(const linalg::MatrixSum& K_hat, const FactorSource& source);
  void find_nodal(const FactorSource& source);
  void find_common(const FactorSource& source);
  void find_responses(const FactorSource& source);
  void find_row_answers();
  void divide(linalg::SharedStore* known);
  std::shared_ptr<const BodyResponses> make_responses(const BodyResponses::Source& source);
  SmallBodyAnswers answers_by_variables() const;
  /// X ← Y K̂⁻¹ X, as part of the set-up.
  void solve_columns(linalg::Matrix& X);

  const body::FlexiblePart* part_;
  linalg::Vector diagonal_;  // of K̂
  bool is_shared_ = false;
  linalg::Vector diagonal_inverse_;  // of diagonal K̂, else empty; then there is no factor
  std::shared_ptr<const linalg::Factor> factor_;
  std::string why_solver_;
  linalg::Matrix inverse_;  // Y K̂⁻¹ of small bodies, else empty
  InterfaceRows N_;         // of the interface
  bool has_patterns_;
  std::shared_ptr<const body::NodalMotion> nodal_;
  linalg::CommonTable common_;
  std::shared_ptr<const BodyResponses> responses_;
  linalg::Matrix rigid_row_values_;
  InertialLoad inertial_;
  std::shared_ptr<const DividedBody> divided_;
  long setup_solves_ = 0;
};

}  // namespace buckens::stepping
