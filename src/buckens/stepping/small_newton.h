// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/stepping/body_step.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// The iteration of one step in frame coordinates, interface values and multipliers only.
///
/// Flexible bodies enter by their interface compliance, FM (42); no n-sized vector is touched.
/// Position and velocity rows of the joints are closed together: the multipliers λ close the
/// velocities, a correction q ← q + W⁻¹Gᵀη without velocity closes the positions (stabilised index
/// 2).
///
/// Directions of the correction and the matrix of the iteration are those at the predicted
/// configuration. Residuals are exact, so the result does not depend on the approximation.
class SmallNewton {
 public:
  /// @param rows_in_use independent rows of λ; the others follow from them and are left at zero
  SmallNewton(const model::Model& model, const Scheme& scheme, const StepSettings& settings,
              std::vector<const BodyStepOperator*> operators, std::vector<int> rows_in_use);

  /// Condenses the joints at the predicted configuration held in `bodies`.
  /// @throws NumericalError naming joints if their equations have become dependent
  void prepare(std::vector<BodyStep>& bodies, double t);

  /// Iterates until the motion no longer changes.
  /// @param lambda first guess and result [N, N m]
  /// @throws NumericalError with the joint that resists, if it does not converge
  void iterate(std::vector<BodyStep>& bodies, double t, linalg::Vector& lambda, StepReport& report);

  /// Forces at the evaluation instant of the last iteration.
  const dynamics::Forces& forces() const { return forces_; }
  const std::vector<dynamics::BodyMotion>& motions_at_end() const { return end_; }
  const std::vector<int>& rows_in_use() const { return rows_in_use_; }
  /// How often other rows were taken into use because pivots dropped or a row opened.
  int num_selections() const { return num_selections_; }

 private:
  struct Change {
    double size = 0;    ///< largest change of this iteration [m]
    double motion = 0;  ///< largest motion of the step [m]
  };
  void evaluate(std::vector<BodyStep>& bodies, double t, const linalg::Vector& lambda);
  void residual_step(const std::vector<BodyStep>& bodies);
  void solve_correction(const std::vector<BodyStep>& bodies);
  void solve_multipliers(const std::vector<BodyStep>& bodies);
  Change update(std::vector<BodyStep>& bodies, linalg::Vector& lambda);
  bool settled(const Change& change, const Change& before) const;
  void record_residuals(StepReport& report) const;
  const dynamics::Constraints& at_evaluation() const;
  bool is_quasi_static(std::size_t body) const;
  /// Replaces ġ by that without position corrections and with shapes as at the start of the step: a
  /// quasi-static shape that changes must not throw the mechanism about, Δλ ~ m w Δy/h.
  void keep_shapes_in_rates(const std::vector<BodyStep>& bodies, double t_end);
  /// A joint row as it closes velocities: deformation without rates has no part in it.
  dynamics::SystemRow without_rates(dynamics::SystemRow row) const;
  bool corrects_positions() const;
  /// Assembles and factorises S for the rows in use. @return false if it is singular
  bool condense();
  /// Asks again which rows are independent. @return true if others are used from now on
  bool select_rows_anew();
  /// Multipliers of rows that were given up are zero.
  void leave_to_rows_in_use(linalg::Vector& lambda) const;
  /// Notes a row not in use that no longer follows from the others.
  void watch_rows_not_in_use();
  [[noreturn]] void fail(double t, const StepReport& report, const char* what) const;

  const model::Model& model_;
  Scheme scheme_;
  StepSettings settings_;
  std::vector<const BodyStepOperator*> operators_;
  std::vector<int> rows_in_use_;
  std::vector<int> dependent_;  // at the last selection
  double trusted_pivots_ = 0;   // largest pivot ratio since rows were last selected
  double largest_gap_ = 0;      // of rows not in use
  bool has_open_rows_ = false;
  bool has_quasi_static_ = false;
  int num_selections_ = 0;
  std::unique_ptr<dynamics::MultiplierCondensation> condensation_;

  std::vector<dynamics::BodyMotion> end_, evaluation_;
  dynamics::Constraints constraints_end_, constraints_evaluation_;
  dynamics::Forces forces_;
  dynamics::SoftRows soft_;
  std::vector<dynamics::SystemRow> test_rows_, force_rows_;  // in use, then soft
  std::vector<double> soft_stiffness_share_;                 // k θ / k_eff
  std::vector<dynamics::BodyCompliance> compliance_;

  std::vector<Vector6> residual_frame_;      // −W⁻¹ c r
  std::vector<Eigen::VectorXd> residual_y_;  // change of y_end at fixed λ
  std::vector<dynamics::BodyResponse> correction_, response_;
  std::vector<Vector6> correction_u_;  // W⁻¹ Gᵀ E
  linalg::Vector E_, X_;
  std::size_t restless_body_ = 0;  // whose frame moved most in the last iteration
};

}  // namespace buckens::stepping
