// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/linalg/row_rank.h"
#include "buckens/model/model.h"

namespace buckens::dynamics {

/// Response of all bodies to interface forces through their mass alone: the metric for initial
/// velocities, initial accelerations and the rank of the joint equations.
///
/// Flexible bodies: H = Y M⁻¹Nᵀ by conjugate gradients, one solve per interface row, no
/// factorisation. Not from several threads at once.
class MassMetric {
 public:
  explicit MassMetric(const model::Model& model);

  /// Frame part only: bodies move rigidly.
  std::vector<BodyCompliance> rigid() const;
  /// Frames and meshes. @param J current rotary inertia of each body [kg m²]
  std::vector<BodyCompliance> full(const std::vector<Eigen::Matrix3d>& J) const;

  /// Y M⁻¹Nᵀ of one body, n×interface rows. The reference ends with let_go().
  const linalg::Matrix& H(std::size_t body) const;
  /// Frees H of bodies whose M other processes have: steps do not need it, and who asks next has it
  /// made again.
  void let_go() const;
  const linalg::Matrix& interface(std::size_t body) const { return interface_[body]; }

  /// Splits joint rows into independent ones and those that follow from them.
  ///
  /// Rank-revealing QR of the Jacobian in the mass metric, rows scaled to unit length; tolerance
  /// 1e-9, between rounding (1e-15) and the smallest lever arm worth a joint.
  linalg::RowRank split(const std::vector<SystemRow>& rows) const;

  /// Rows of the Jacobian times the square root of the mass metric, unscaled.
  linalg::SparseMatrix weighted_jacobian(const std::vector<SystemRow>& rows) const;

 private:
  const model::Model& model_;
  mutable std::vector<linalg::Matrix> H_;
  std::vector<linalg::Matrix> interface_, interface_root_;
  std::vector<Eigen::MatrixXd> frame_root_;  // 6×k per body
  std::vector<int> first_column_;
  int num_columns_ = 0;
};

/// Frame compliance of a body with the rotary inertia J: zero where it has no coordinate.
Eigen::Matrix<double, 6, 6> frame_mobility(const body::Body& body, const Eigen::Matrix3d& J);

/// Multipliers of least norm (torques counted divided by the model's length) that exert the same
/// forces as `lambda`. Unique forces even where joints are redundant.
linalg::Vector least_multipliers(const model::Model& model, const MassMetric& metric,
                                 const std::vector<SystemRow>& rows, const linalg::Vector& lambda);

}  // namespace buckens::dynamics
