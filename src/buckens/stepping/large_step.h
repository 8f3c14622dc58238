// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/linalg/recycled_solves.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

/// The n-sized part of a step of one flexible body: right-hand side, what follows from its
/// solution, and the state at the end.
///
/// Vectors of a large mesh are read from memory each time, since the factor passes through the
/// caches in between. So each is read as rarely as possible: everything from the past is a
/// combination of d, ḋ, d̈ and the algorithmic accelerations a at the start (Scheme), and is formed
/// where it is needed; another solve in the step takes only the change of the load. With m
/// interface rows and c columns of them and patterns, these numbers per variable pass through
/// memory in addition to the factor:
///
///     form_right_side    4 read, 1 written, a product with M;    the change of a load: none
///     take_solution      5 + 6 (sieve) + 6 (patterns) read, 1 written
///     complete           5 + 6 (sieve) + c + 2 m read, 4 written
///
/// Of solids (body::NodalMotion) sieve and patterns take 4/3 together, in either of them.
///
/// The rows are distributed over the threads of a pool; results do not depend on their number. Once
/// the vectors have their sizes, nothing is allocated.
class LargeStep {
 public:
  explicit LargeStep(BodyStepOperator& op);

  /// Forms the right-hand side of FM (37),  K̂ x_e = c θ F + M (m x₀ − cθ ẍ₀) + C (d x₀ − cθ ẋ₀),
  /// x₀ = x + offset, x⁺ = x + (x_e − x₀)/θ.
  /// @param load F, nodal load at the evaluation instant, n; empty for none
  void form_right_side(const model::BodyState& before, const linalg::NodalVector& load,
                       TaskPool* pool);
  /// Forms the right-hand side for the change of x⁺ by a change of F.
  void form_right_side_of_change(const linalg::NodalVector& before,
                                 const linalg::NodalVector& after, TaskPool* pool);
  /// The right-hand side, to be solved in place. @pre !is_divided()
  linalg::Vector& side() { return is_first_ ? free_ : change_; }
  /// Whether other processes have the rows of all vectors (DividedBody).
  bool is_divided() const { return op_->divided() != nullptr; }
  /// Then: solves for the right-hand side.
  void solve_divided(const linalg::Factor& factor);
  /// Then: the right-hand side, for RecycledSolves.
  linalg::RecycledSolves::DividedLoad divided_side();
  /// Sieves the right-hand side, for a solver that iterates: what K̂⁻¹ makes of rigid motion would
  /// be sieved in any case, but counts in the error that a solve may have.
  void sieve_side();
  /// Solves for the sieved right-hand side by iteration.
  ///
  /// The first solve begins at the motion d + h ḋ + ½ h² d̈ with those loads along N that come
  /// closest to K̂ x = b; so the estimate depends on the state only. A change begins at zero and has
  /// an error that is negligible beside the whole motion.
  void iterate(const model::BodyState& before, const linalg::Factor& factor);
  /// Makes the motion without loads along N of the solution in side(), sieved by FM (38), (39), and
  /// its row values.
  /// @param y_free N x⁺; zero for patterns that the body's terms do not use
  void take_solution(const model::BodyState& before, Eigen::VectorXd& y_free, TaskPool* pool);

  /// Adds the responses to loads along N, FM (42), and forms the nodal state at the end.
  /// @param load along the rows of N, centrifugal weights included
  /// @param correction load of the position correction e
  void complete(const model::BodyState& before, const Eigen::VectorXd& load,
                const Eigen::VectorXd& correction, model::BodyState& after, TaskPool* pool);

  /// State where the equations of motion hold, after complete(): `after` itself at the end.
  const linalg::NodalVector& d_e(const model::BodyState& after) const {
    return holds_at_end_ ? after.d : d_e_;
  }
  const linalg::NodalVector& rate_e(const model::BodyState& after) const {
    return holds_at_end_ ? after.d_dot : rate_e_;
  }
  const linalg::NodalVector& acceleration_e(const model::BodyState& after) const {
    return holds_at_end_ ? after.d_ddot : acceleration_e_;
  }
  /// Whether all numbers at the end of the step are finite.
  bool is_finite() const { return is_finite_; }

  BodyStepOperator& op() { return *op_; }
  const BodyStepOperator& op() const { return *op_; }

 private:
  /// Weights of a combination of d, ḋ, d̈ and a at the start of the step.
  struct Weights {
    double d = 0, rate = 0, acceleration = 0, algorithmic = 0;
    Weights operator+(const Weights& o) const {
      return {d + o.d, rate + o.rate, acceleration + o.acceleration, algorithmic + o.algorithmic};
    }
    Weights operator*(double s) const {
      return {s * d, s * rate, s * acceleration, s * algorithmic};
    }
  };
  // Of at most six rigid motions: needs no allocation.
  using Amplitudes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
  /// Sums of one part.
  struct PartSums {
    Amplitudes rigid;
    Eigen::Matrix<double, 6, 1> patterns;
    linalg::NodeSums nodal_rigid, nodal_patterns;
    double total = 0;
  };
  /// Nodal variables of a state, asked for once before the pieces are worked on.
  struct Start {
    explicit Start(const model::BodyState& s)
        : d(s.d), d_dot(s.d_dot), d_ddot(s.d_ddot), d_alg(s.d_alg) {}
    const linalg::Vector &d, &d_dot, &d_ddot, &d_alg;
  };
  struct End {
    End(model::BodyState& s, Eigen::Index n)
        : d(s.d.overwrite(n)),
          d_dot(s.d_dot.overwrite(n)),
          d_ddot(s.d_ddot.overwrite(n)),
          d_alg(s.d_alg.overwrite(n)) {}
    linalg::Vector &d, &d_dot, &d_ddot, &d_alg;
    linalg::Vector *d_e = nullptr, *rate_e = nullptr, *acceleration_e = nullptr;
  };
  static auto combination(const Weights& w, const Start& s, Eigen::Index first, Eigen::Index size) {
    return w.d * s.d.segment(first, size) + w.rate * s.d_dot.segment(first, size) +
           w.acceleration * s.d_ddot.segment(first, size) +
           w.algorithmic * s.d_alg.segment(first, size);
  }
  void clear_sums();
  void add_rigid(Eigen::Index first, Eigen::Index size, const linalg::Vector& x, PartSums& sums);
  void add_patterns(Eigen::Index first, Eigen::Index size, PartSums& sums);
  void estimate_solution(const model::BodyState& before, linalg::Vector& x);
  void form_end(const Start& before, Eigen::Index first, Eigen::Index size, const End& after);

  /// What follows from a solution by sums over all rows.
  struct SolutionSums {
    Amplitudes rigid;
    Eigen::Matrix<double, 6, 1> patterns = Eigen::Matrix<double, 6, 1>::Zero();
    linalg::Vector interface;
  };
  struct Past;
  void pass_solution(const model::BodyState& before, bool uses_patterns, bool has_both,
                     TaskPool* pool);
  void form_divided_right_side(const model::BodyState& before, const linalg::NodalVector& load);
  void form_divided_change(const linalg::NodalVector& before, const linalg::NodalVector& after);
  SolutionSums take_divided_solution(const model::BodyState& before, bool uses_patterns,
                                     bool has_both);
  void complete_divided(const model::BodyState& before, const Eigen::VectorXd& load,
                        const Eigen::VectorXd& correction, model::BodyState& after);

  BodyStepOperator* op_;
  linalg::RowParts rows_;
  bool holds_at_end_;  // the equations of motion
  // Of the past: with M and C on the right-hand side; added to the solution; rates and
  // accelerations at the evaluation instant, rates at the end.
  Weights with_mass_, with_damping_, beside_solution_, from_start_;
  Weights mean_velocity_, acceleration_, velocity_, offset_;
  // Carried and algorithmic acceleration at the end.
  double carried_before_ = 0, carried_new_ = 1;
  double algorithmic_before_ = 0, algorithmic_old_ = 0, algorithmic_new_ = 1;

  bool is_first_ = true;
  linalg::Vector free_;    // x⁺ without loads along N, Φ rigid_ still in it
  linalg::Vector change_;  // of it by a later solve
  linalg::Vector scratch_, damped_;
  Weights estimate_;           // of the solution
  linalg::Vector iterated_;    // solution by iteration
  double energy_ = 0;          // √(xᵀK̂x) of the first one
  linalg::Matrix loads_of_N_;  // from misfits along N to loads along N, (N G)⁻¹
  Amplitudes rigid_;
  Eigen::Matrix<double, 6, 1> pattern_values_;  // of free_
  std::vector<PartSums> sums_;
  // Empty if the equations hold at the end.
  linalg::NodalVector d_e_, rate_e_, acceleration_e_;
  linalg::DividedVector free_there_, change_there_;  // in place of free_ and change_
  bool is_finite_ = true;
};

}  // namespace buckens::stepping
