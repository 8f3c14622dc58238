// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/statics/stability.h"
#include "buckens/analysis/statics/system.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::analysis {

/// An equilibrium on a static path with what is needed to continue from it.
struct PathPoint {
  StaticPoint point;
  StaticBalance balance;
  double position = 0;       ///< along the path, in full steps
  linalg::Vector direction;  ///< scaled unknowns per full step; empty if A is singular
  double load_rate = 0;      ///< change of the load factor per full step
  int iterations = 0;        ///< Newton iterations to get here
  /// Stiffness per mass along the free motions [1/s²], ascending; empty: not examined.
  std::optional<linalg::Vector> stiffness;
  std::string kind;  ///< "limit point", "bifurcation" or empty
};

/// Size of one full step: bounds the change of the load factor and the motion of every body.
struct PathScale {
  double load_factor = 0.1;   ///< |Δμ| > 0
  double motion = 0.05;       ///< rad, or of the model's length
  bool load_control = false;  ///< steps of the load factor alone
};

/// Equilibria of a mechanism as a curve x(s), μ(s) over the load factor μ.
///
///     r(x, μ) = 0,   n_xᵀ Δx + n_μ Δμ = s
///
/// Newton on the bordered system [A b; n_xᵀ n_μ], b = ∂r/∂μ, which is regular at limit points where
/// A is not. The plane is normal to the path, in the unknowns scaled by the model's length; its
/// axes are weighted so that a full step is one in PathScale. With load control n_x is zero.
/// Theory: docs/theory/12-static-paths.md.
class StaticContinuation {
 public:
  /// @param start an equilibrium
  /// @param force scale F of the system [N]
  StaticContinuation(const model::Model& model, const dynamics::MassMetric& metric, RestRows& rest,
                     const std::vector<const ElasticCompliance*>& compliance, double t,
                     const PathScale& scale, double force);

  /// Makes an equilibrium the first point of a path; `sign` says whether μ grows (1) or falls (−1).
  /// @throws NumericalError if the tangent is singular there
  PathPoint begin(const StaticPoint& start, double sign);

  /// The equilibrium `step` ≤ 1 full steps ahead.
  /// @return empty if Newton does not converge; resisting() then says where it ended
  /// @param may_branch accept a point where the path branches and has no unique direction: it keeps
  /// that of `from`
  std::optional<PathPoint> ahead(const PathPoint& from, double step, bool may_branch = false);

  /// The equilibrium at a given load factor near a point of the path.
  std::optional<PathPoint> at_load_factor(const PathPoint& near, double load_factor);

  /// The same point with independent joint rows chosen again: they may change along a path.
  std::optional<PathPoint> with_new_rows(const PathPoint& at);

  /// The nearby point where a row of RestRows opens or closes, and the path beyond it, which may
  /// turn back there, as when a softening structure meets a stop. Empty if no row is about to
  /// change.
  std::optional<PathPoint> around_corner(const PathPoint& at);

  /// Gives rows to pairs of rigid contact groups that may meet within a full step from a point, and
  /// takes them from all others. Within steps from there, pairs are added but not removed.
  void look_around(PathPoint& at);
  /// Transfers a point that was found with other rows to the present ones.
  void fit(PathPoint& at) const;

  /// Cosine of the angle between the path's directions, weighted like a step.
  double alignment(const PathPoint& a, const PathPoint& b) const;

  /// Stiffness along the free motions, see static_modes().
  std::optional<StaticModes> modes(const PathPoint& at, double sigma);

  const StaticSystem& system() const { return *system_; }
  const std::string& resisting() const { return resisting_; }
  /// Largest unbalanced force [N], and largest |g| of all joint rows.
  double force_residual(const PathPoint& at) const;
  double position_residual(const PathPoint& at) const;

 private:
  static constexpr int kMaxIterations = 15;
  /// Further from the prediction than this [rad, or of the model's length], it is another
  /// equilibrium.
  static constexpr double kFarFromPrediction = 0.5;

  /// Plane in which Newton moves, and the direction across it along the path.
  struct Plane {
    linalg::Vector x;
    double load_factor = 0;
  };
  /// A row that is about to open or close, and how far away [full steps].
  struct Corner {
    std::size_t row = 0;
    double ahead = HUGE_VAL;
  };
  Corner nearest_corner(const PathPoint& at);
  /// What is zero at a corner: the gap of an open row, the force of a closed one, growing into what
  /// the row does beyond it.
  struct CornerValue {
    double value = 0;
    linalg::Vector slope;
  };
  CornerValue corner_value(std::size_t row, const StaticPoint& point,
                           const StaticBalance& balance) const;
  bool lead_on(PathPoint& at);
  /// @return whether pairs have been added that may meet on the way, or, unless it `keeps` them,
  ///         removed
  bool follow_pairs(const StaticPoint& from, const StaticPoint& to, bool keeps);
  void fit(StaticPoint& point) const;
  PathPoint fitted(const PathPoint& at) const;
  /// A point ahead along the path's direction, with rows of all that may meet on the way there.
  StaticPoint predicted(PathPoint& from, double step, bool keeps);
  void choose_rows(const StaticPoint& point);
  Plane plane(const PathPoint& at) const;
  Plane load_plane() const;
  linalg::Vector load_derivative(const StaticPoint& point) const;
  bool factorise(const StaticPoint& point, const linalg::Vector& load_derivative,
                 const Plane& plane, double give);
  /// A step in the plane, with the rows closed in `point` that are closed after it.
  bool solve_step(StaticPoint& point, const StaticBalance& balance, const Plane& plane,
                  linalg::Vector& step, double give = StaticSystem::kGive);
  StaticPoint moved(const StaticPoint& point, const linalg::Vector& step) const;
  std::optional<PathPoint> correct(StaticPoint point, const Plane& plane, double longest);
  void polish_and_lead_on(PathPoint& at, const Plane& plane);
  double motion(const linalg::Vector& x) const;
  double misfit(const linalg::Vector& residual) const;
  bool is_balanced(const StaticPoint& point, const StaticBalance& balance,
                   const linalg::Vector& residual) const;
  void remember_resistance(const StaticPoint& point, const linalg::Vector& residual);

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  RestRows& rest_;
  const std::vector<const ElasticCompliance*>& compliance_;
  double t_;
  PathScale scale_;
  double force_;
  double force_rounding_ = 0;  // of stiff springs [N]
  std::optional<StaticSystem> system_;
  std::optional<linalg::SparseLu> lu_;
  std::string resisting_;
};

}  // namespace buckens::analysis
