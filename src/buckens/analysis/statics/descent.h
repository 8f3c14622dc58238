// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/statics/landings.h"
#include "buckens/analysis/statics/stability.h"
#include "buckens/analysis/statics/system.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::analysis {

/// Pseudo-transient continuation of a mechanism towards equilibrium.
///
/// Each iteration is an implicit step of W q̇ = force: Newton with W/τ² added. τ grows if steps are
/// short or the unbalanced force falls, and shrinks if they are long or would lead uphill (negative
/// curvature), so that Newton takes over only near an equilibrium. Pairs of rigid contact groups
/// that may meet in a step have rows in it.
class StaticDescent {
 public:
  StaticDescent(const model::Model& model, const dynamics::MassMetric& metric, RestRows& rest,
                const std::vector<const ElasticCompliance*>& compliance, double t,
                StaticPoint start);

  /// Iterates to equilibrium.
  /// @throws ModelError, NumericalError as find_static_equilibrium()
  void run();
  /// Stiffness of the configuration along its free motions.
  std::optional<StaticModes> modes();
  /// The softest of them, for any number.
  std::optional<StaticModes> softest();
  /// Leaves a saddle along `shape` so that the largest rotation or relative displacement is
  /// `amount`.
  /// @param stiffness κ < 0 of this motion [1/s²]
  void push(const linalg::Vector& shape, double amount, double stiffness);

  const StaticSystem& system() const { return *system_; }
  const StaticPoint& point() const { return point_; }
  const StaticBalance& balance() const { return balance_; }
  /// A force that is none [N].
  double force_tolerance() const;
  int iterations() const { return iterations_; }
  double force_residual() const;
  double largest_force() const { return largest_force_; }
  /// Relevant σ [1/s²]: the square of the rate at which the start would move away.
  double reference() const { return reference_; }

 private:
  static constexpr double kLongestStep = 0.3;  ///< rad, or of the model's length
  /// Of the relevant σ: keeps directions without stiffness at rest.
  static constexpr double kLeastInertia = 1e-9;

  void choose_rows();
  void set_scales();
  void evaluate();
  bool follow_pairs(const StaticPoint& to, bool keeps);
  bool is_balanced() const;
  double misfit() const;
  bool factorise(const linalg::SparseMatrix& tangent);
  linalg::Vector find_step();
  bool solve_step(linalg::Vector& step, double give = StaticSystem::kGive);
  bool solve_with_pivots(linalg::Vector& step, double give, const RestStands& before);
  bool lands(const linalg::Vector& step);
  void share_loads();
  RestStands loaded_rows() const;
  bool leads_uphill(const linalg::SparseMatrix& tangent, const linalg::Vector& step) const;
  double motion_size(const linalg::Vector& step) const;
  void advance(const linalg::Vector& step);
  bool goes_to_and_fro(double residual, double size);
  void polish();
  void check_dependent_rows();
  void check_travel() const;
  [[noreturn]] void refuse(const std::string& motion) const;

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  RestRows& rest_;
  Landings landings_;
  const std::vector<const ElasticCompliance*>& compliance_;
  double t_;
  StaticPoint point_, start_;
  std::vector<Eigen::Vector3d> turned_;  // sum of the steps, body axes [rad]
  std::optional<StaticSystem> system_;
  std::optional<linalg::SparseLu> lu_;
  StaticBalance balance_;
  linalg::Vector residual_;
  double force_ = 1;           // scale [N]
  double reference_ = 1;       // relevant σ [1/s²]
  double sigma_ = 1;           // 1/τ² [1/s²]
  double start_force_ = 0;     // largest load at the start [N]
  double largest_force_ = 0;   // at the start or the point [N]
  double force_rounding_ = 0;  // of stiff springs [N]
  double no_force_ = 0;        // negligible force, see set_scales() [N]
  int iterations_ = 0;
  int num_landings_ = 0;              // iterations that ended where a contact begins to press
  double least_residual_ = HUGE_VAL;  // scaled, so far
  int without_gain_ = 0;              // iterations since it has fallen
  double way_without_gain_ = 0;       // sum of the steps since then
  std::vector<spatial::Pose> best_;   // where it was
  std::vector<Eigen::Vector3d> best_turned_;
  int row_choices_ = 0;
  std::string lost_text_;  // of rows that found no end in the last step; empty: they did
};

}  // namespace buckens::analysis
