// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/statics/elastic_compliance.h"
#include "buckens/analysis/statics/linearised_loads.h"
#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

/// A configuration of the mechanism in the unknowns of the static problem.
struct StaticPoint {
  std::vector<spatial::Pose> poses;  ///< X_WB
  std::vector<Eigen::VectorXd> y;    ///< interface values of the flexible bodies, empty: rigid
  linalg::Vector lambda;             ///< multipliers of all joint rows; unused rows are zero
  RestStands rest;                   ///< of RestRows
  RestOrder order;                   ///< of the pairs that have rows among them
  double load_factor = 1;            ///< of applied forces and torques
};

/// The bodies at rest in a configuration.
std::vector<dynamics::BodyMotion> motions_at(const model::Model& model, const StaticPoint& point);

/// The bodies in one configuration, with velocities that lead to another one within 1 s.
std::vector<dynamics::BodyMotion> motions_towards(const model::Model& model,
                                                  const StaticPoint& from, const StaticPoint& to);

/// Everything that acts in a configuration.
struct StaticBalance {
  dynamics::Forces forces;            ///< with joint forces: zero frame loads in equilibrium
  dynamics::Constraints constraints;  ///< of all joint rows
  RestValues rest;                    ///< of RestRows
};

/// The equations of static equilibrium and their tangent.
///
///     −(f + G_qᵀλ) = 0      frames, in the coordinates that each body has
///     y − N K⁺Nᵀ f_y = 0    flexible bodies, f_y = interface loads of joints and force elements
///     g = 0                 joints, independent rows only
///     gap = 0 or f = 0      rows of force laws that hold at rest, closed or open
///
/// Unknowns: increments of the frame coordinates and y body by body, then λ and f. All are scaled
/// by the model's length L and a force F, so that the tangent is as symmetric as the loads are
/// conservative. Derivatives of forces are those of LinearisedLoads; those of joints and
/// multipliers are exact.
class StaticSystem {
 public:
  /// Fraction of its own compliance by which a closed row of RestRows yields to a change of its
  /// force within an iteration, so that rows that hold the same thing have definite forces.
  /// Rounding moves forces among them by about 1e-16 of the change, divided by this.
  static constexpr double kGive = 1e-10;
  /// The same when their forces are computed afresh.
  static constexpr double kGiveOfSharing = 1e-6;

  /// @param compliance one entry per body, null for rigid ones
  /// @param rest must outlive this object
  /// @param rows_in_use independent rows of λ
  /// @param force F > 0 [N]
  StaticSystem(const model::Model& model, const RestRows& rest,
               const std::vector<const ElasticCompliance*>& compliance,
               std::vector<int> rows_in_use, double t, double force);

  StaticBalance balance(const StaticPoint& point) const;
  /// Scaled residual of all equations.
  linalg::Vector residual(const StaticPoint& point, const StaticBalance& balance) const;
  /// Evaluates the derivatives of the residual.
  void linearise(const StaticPoint& point, const StaticBalance& balance);
  /// Tangent plus σ times the mass matrix of the frames, scaled; always the same pattern.
  /// @param stands which rows of RestRows are closed, @param give see kGive
  linalg::SparseMatrix tangent(double sigma, const RestStands& stands, double give = kGive) const;
  /// The mass matrix of the frames in the same scaling; empty rows elsewhere.
  linalg::SparseMatrix mass() const;
  /// The configuration after a step of the scaled unknowns.
  StaticPoint moved(const StaticPoint& point, const linalg::Vector& step) const;

  int size() const { return size_; }
  double force() const { return force_; }
  const std::vector<int>& rows_in_use() const { return rows_in_use_; }

  enum class Share { frame, elastic, joint };
  /// The kind of equation (and unknown) at an index.
  Share share(int index) const { return shares_[static_cast<std::size_t>(index)]; }
  /// Body of a frame or elastic index.
  std::size_t body_at(int index) const;
  /// "joint "crank"" or "load "stop"" of a joint index.
  std::string owner_at(int index) const;
  const RestRows& rest() const { return rest_; }
  /// The part of a step that changes forces of joints and rows alone.
  linalg::Vector forces_of(const linalg::Vector& step) const;
  /// Change of the force of a row of RestRows in a step, and of its coordinate.
  double force_change(std::size_t row, const linalg::Vector& step) const;
  double gap_change(std::size_t row, const linalg::Vector& step) const;
  /// The same for all steps at once: scaled force, and scaled coordinate, of a row per unit step.
  linalg::Vector force_slope(std::size_t row) const;
  linalg::Vector gap_slope(std::size_t row) const;
  double scaled_force(std::size_t row, double force) const {
    return force / column_scale_[first_rest_ + static_cast<int>(row)];
  }
  double scaled_gap(std::size_t row, double gap) const {
    return gap * row_scale_[first_rest_ + static_cast<int>(row)];
  }
  /// Largest interface value, scaled as elastic equations are.
  double largest_deformation(const StaticPoint& point) const;
  /// Largest magnitude of a scaled vector over one kind of equation or unknown.
  double largest(const linalg::Vector& scaled, Share share) const;
  /// Motion of a body's frame in a step: rotation in body axes [rad], translation [m].
  Eigen::Matrix<double, 6, 1> frame_step(std::size_t body, const linalg::Vector& step) const;

 private:
  void lay_out();
  void add_mass();
  void add_joint_derivatives(const StaticBalance& balance);
  void add_rest_derivatives(const StaticBalance& balance);
  /// @param index of its multiplier, @param closes,acts where its derivatives and its force go
  void add_row(int index, const dynamics::BodyRow& part, std::vector<linalg::Triplet>& closes,
               std::vector<linalg::Triplet>& acts) const;
  Eigen::VectorXd body_residual(std::size_t body, const Eigen::Matrix<double, 6, 1>& frame,
                                const Eigen::VectorXd& interface) const;
  int num_unknowns(std::size_t body) const;
  void put(int row, int column, double value, std::vector<linalg::Triplet>& to) const;

  const model::Model& model_;
  const RestRows& rest_;
  const std::vector<const ElasticCompliance*>& compliance_;
  std::vector<int> rows_in_use_;
  double t_;
  double force_;
  LinearisedLoads loads_;
  int size_ = 0;
  int first_multiplier_ = 0, first_rest_ = 0;
  std::vector<int> first_, num_frame_;  // unknowns of each body
  std::vector<Share> shares_;
  linalg::Vector row_scale_, column_scale_;
  std::vector<linalg::Triplet> derivatives_, mass_;
  std::vector<std::vector<linalg::Triplet>> closes_;  // of RestRows, row by row
  std::vector<double> compliances_;                   // their own, scaled
};

}  // namespace buckens::analysis
