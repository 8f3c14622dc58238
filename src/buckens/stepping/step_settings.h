// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/shared_store.h"
#include "buckens/linalg/simd_level.h"
#include "buckens/linalg/solve_exchange.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// How one step is taken.
struct StepSettings {
  Method method = Method::generalized_alpha;
  double step = 1e-3;               ///< h [s]
  double rho_inf = 0.9;             ///< numerical damping of generalised-α
  double alpha = -0.1;              ///< numerical damping of HHT, −1/3 … 0
  double theta = 1.4;               ///< Wilson's θ
  bool position_projection = true;  ///< Newmark: project positions after the velocity-level step
  double newton_tolerance = 1e-10;  ///< change of positions relative to the step's motion
  double outer_tolerance = 1e-6;    ///< relative change of the coupling load
  bool iterate_coupling = false;    ///< to outer_tolerance; otherwise a second large solve is the
                                    ///< last if its coupling load was accurate to 1e-4
  /// Largest number of responses to changes of the coupling load that are kept per factor, for
  /// recycling; 0: none.
  int kept_solves = 80;
  int max_newton = 40;
  int max_outer = 30;
  int threads = 1;  ///< ≥ 1; does not influence results
  /// These threads, which outlive the stepper; null: it starts its own.
  TaskPool* pool = nullptr;
  /// Small bodies of large mechanisms step eight at a time; otherwise one by one, which is slower.
  bool side_by_side = true;
  /// Instruction set for these; the processor must have it.
  linalg::SimdLevel simd = linalg::best_simd_level();
  /// Per joint, whether it has let go where the rows in use were chosen; empty: none has.
  std::vector<char> released;
  /// Shares factors and solves with steppers that run side by side; null: alone.
  linalg::SolveExchange* exchange = nullptr;
  /// Factorises the step matrices of bodies instead of linalg::make_large_factor(); an exchange
  /// has its own.
  linalg::MakeFactor make_factor;
  /// Vectors that other processes have, for steppers of other lengths of step; null: none in
  /// common.
  linalg::SharedStore* vectors = nullptr;

  /// The parameter of the method, for Scheme.
  double method_parameter() const {
    return method == Method::hht ? alpha : method == Method::wilson ? theta : rho_inf;
  }
};

/// Energy that an impact took at one stop or contact, or by friction there.
struct ImpactShare {
  std::size_t load;  ///< index into Model::loads
  double energy;     ///< [J]
};

/// Shape of a mesh and its rates at one instant; empty if they are not known.
struct ShapeAndRates {
  linalg::Vector d, d_dot;
};

class FrictionOfStep;

/// Effort and residuals of one step.
struct StepReport {
  int newton_iterations = 0;
  int large_solve_rounds = 0;    ///< rounds in which some body solved; 0: all rigid
  int recycled_rounds = 0;       ///< rounds for which kept solves sufficed
  double position_residual = 0;  ///< max |g| [m] or [-]
  double velocity_residual = 0;  ///< max |ġ|
  int worst_row = -1;            ///< of λ, where |g| is largest
  /// The same for all rows on one scale: lengths as fractions of the model's length, angles in rad.
  double opening = 0;          ///< [-]
  double opening_rate = 0;     ///< [1/s]
  int most_open_row = -1;      ///< of λ, where the opening is largest
  double coupling_change = 0;  ///< last relative change of the coupling load
  int impacts = 0;             ///< against rigid stops
  double impact_loss = 0;      ///< energy lost in them [J]
  /// Number of those that should have rebounded but were stopped, because friction jams.
  int jammed_impacts = 0;
  /// Whether some impulses are those of ConeEnd::near: sliding places separate or approach at a
  /// millionth of the largest rate at most.
  bool has_near_impulses = false;
  std::span<const ImpactShare> impact_shares{};  ///< of the loss, valid until the next step
  /// Per body, shape and rates at the end of the step before impacts whose loss is the energy that
  /// all bodies lose; empty if there are none. Valid until the next step.
  std::span<const ShapeAndRates> before_blows{};
  /// Dry friction in joints; null if there is none, or not known. Valid until the next step.
  const FrictionOfStep* friction = nullptr;
  double impact_rest = 0;  ///< from their mean instant to the end of the step [s]
  /// Whether accelerations have jumped and have to be computed afresh at the end of the step:
  /// because of impacts, or because the stands of rigid rows have changed.
  bool must_settle = false;
  /// Whether an end on a mesh has let go, or pulls at the end of the step only, without impacts:
  /// rates then have to be set to their mean first, see Stepper::take_mean_of_turning().
  bool ends_have_turned = false;
  /// Whether no combination of holding and releasing satisfied all rigid rows, and the last one was
  /// accepted.
  bool has_undecided_rows = false;
};

}  // namespace buckens::stepping
