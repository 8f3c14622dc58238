// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/stepping/body_step.h"
#include "buckens/stepping/large_step.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// The inertial coupling, FM (21)–(24), that a large solve treats as given, and how far that is
/// from the coupling of its result.
///
/// A change ΔF of the nodal load F is judged relative to the whole coupling load of the body,
///
///     ‖ΔF‖ / √(‖F‖² + ‖ĉ‖²),      ‖f‖² = Σ fᵢ²/K̂ᵢᵢ,
///
/// ĉ the centrifugal load of the undeformed body. The norm of K̂⁻¹ itself would cost the very solve
/// that is being decided on; the diagonal replaces it (docs/theory/08-coupling.md).
class LaggedCoupling {
 public:
  LaggedCoupling(const body::Body& body, const BodyStepOperator& op);

  /// Distance of the coupling from the one used to compute the step.
  struct Gap {
    bool load_changed = false;   ///< by more than the tolerance
    bool frame_changed = false;  ///< the same of moments of the frame
    double change = 0;           ///< the larger of both, relative
    double motion = 0;           ///< caused by it, relative to the model's length

    bool is_settled() const { return !load_changed && !frame_changed; }
  };

  /// Sizes of a change, by which it is judged.
  struct Change {
    double load = 0;        ///< of the nodal load
    double load_size = 0;   ///< of the whole coupling load, √(‖F‖² + ‖ĉ‖²)
    double moved = 0;       ///< by it in this step [m]
    double frame = 0;       ///< of the inertia of the frame
    double frame_size = 0;  ///< of this inertia
    double turned = 0;      ///< by it in this step [rad]
  };
  /// Where the coupling is not iterated, a change that moves a small body by less than what
  /// rounding leaves of its motion counts as none: short parts of a divided beam deform so little
  /// that their coupling never matters.
  /// @param L length of the model, for Gap::motion [m]
  static Gap judge(const Change& change, const body::Body& body, const StepSettings& settings,
                   double L);

  /// Extrapolates the coupling from the last steps for the step from `state`.
  /// @param history number of valid coupling entries in the state
  void start(const model::BodyState& state, int history, double t, TaskPool* pool);
  /// Evaluates with the result of a solve and compares.
  /// @param after nodal state at the end as LargeStep formed it
  /// @param t start of the step [s]
  /// @param L length of the model, for Gap::motion [m]
  Gap evaluate(const BodyStep& step, const LargeStep& large, const model::BodyState& after,
               double t, const StepSettings& settings, double L, TaskPool* pool);
  /// Adopts what was evaluated: the moments and, if it changed, the load.
  void take_over();

  const model::Coupling& used() const { return used_; }
  model::Coupling& evaluated() { return evaluated_; }
  /// Load that take_over() has replaced.
  const linalg::NodalVector& load_before() const { return evaluated_.load; }
  /// Size of the whole coupling load, √(‖F‖² + ‖ĉ‖²), at the last evaluation.
  double load_size() const { return load_size_; }
  /// 1/K̂ᵢᵢ, which makes the norm; empty if there are no loads.
  const linalg::Vector& inverse_diagonal() const { return inverse_diagonal_; }
  /// Frees that where other processes compare loads, so that nobody needs it here any more.
  void let_go() {
    if (divided_ != nullptr) inverse_diagonal_ = linalg::Vector();
  }
  /// Whether take_over() changed the load, so that another solve is needed.
  bool load_changed() const { return load_changed_; }

 private:
  int known_instants(const model::BodyState& s, int history) const;
  struct Sizes {
    double change = 0, load = 0;  // squares
    double moved = 0;
  };
  Sizes compare_loads(TaskPool* pool);
  Sizes evaluate_coupling(const body::CouplingTerms& terms, const linalg::NodalVector& d,
                          const linalg::NodalVector& rate, const linalg::NodalVector& acceleration,
                          const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot, bool compares,
                          model::Coupling& out, TaskPool* pool);
  void extrapolate_divided(const model::BodyState& s, int history, double t);
  Sizes evaluate_divided(const body::CouplingTerms& terms, const linalg::NodalVector& d,
                         const linalg::NodalVector& rate, const linalg::NodalVector& acceleration,
                         const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot, bool compares,
                         model::Coupling& out);

  const body::Body* body_;
  Scheme scheme_;
  const linalg::CommonTable* common_;  // of a solid, or null
  linalg::RowParts rows_;
  linalg::Vector inverse_diagonal_;         // of K̂; empty if there are no loads
  linalg::Vector moved_per_load_;           // the same as displacements; empty: are some
  const DividedBody* divided_;              // null: all is here
  linalg::DividedVector moved_there_;       // in place of moved_per_load_
  Eigen::Matrix<double, 6, 6> undeformed_;  // cᵀ D⁻¹ c of the patterns c
  model::Coupling used_, evaluated_;
  bool load_changed_ = true;
  double load_size_ = 0;
};

}  // namespace buckens::stepping
