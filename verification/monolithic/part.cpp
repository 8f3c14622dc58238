// SPDX-License-Identifier: Apache-2.0
#include "verification/monolithic/part.h"

#include <vector>

#include "buckens/body/rigid_modes.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/spatial/rotation.h"

namespace buckens::verification {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

/// P = MΦ with unit columns; columns without mass or dependent on others are left out.
Matrix independent_multipliers(const body::Body& b) {
  std::vector<Vector3d> positions;
  for (const auto& node : b.flexible->fe.nodes) positions.push_back(node.position);
  const Matrix Phi = body::rigid_modes(positions, b.flexible->fe.dofs, b.com);
  Matrix P = b.flexible->fe.M * Phi;
  const double largest = P.colwise().norm().maxCoeff();
  for (Eigen::Index k = 0; k < P.cols(); ++k) {
    const double norm = P.col(k).norm();
    P.col(k) *= norm > 1e-12 * largest ? 1.0 / norm : 0.0;
  }
  const linalg::PivotedQr qr(P, 1e-9);
  Matrix out(P.rows(), qr.rank());
  for (Eigen::Index k = 0; k < qr.rank(); ++k) {
    out.col(k) = P.col(qr.order()[static_cast<std::size_t>(k)]);
  }
  return out;
}

}  // namespace

MonolithicStepper::Part::Part(const body::Body& b) : body(b) {
  const auto rotations = b.rotation_basis.cols();
  const auto translations = b.translation_basis.cols();
  basis = MatrixXd::Zero(6, rotations + translations);
  basis.topLeftCorner(3, rotations) = b.rotation_basis;
  basis.bottomRightCorner(3, translations) = b.translation_basis;
  if (b.is_flexible()) P = independent_multipliers(b);
}

void MonolithicStepper::Part::set_moments(const Vector& d, const Vector& d_dot) {
  const auto& patterns = body.flexible->invariants.centrifugal_patterns();
  moments = dynamics::frame_moments(body, before->terms, coupling.moments, patterns.transpose() * d,
                                    patterns.transpose() * d_dot);
}

MonolithicStepper::Part::Matrix6 MonolithicStepper::Part::metric(const stepping::Scheme& scheme,
                                                                 const Vector3d& w) const {
  Matrix6 out = Matrix6::Zero();
  out.topLeftCorner<3, 3>() =
      scheme.mass * moments.J + scheme.damping * dynamics::gyroscopic_tangent(moments, w);
  out.bottomRightCorner<3, 3>() = scheme.mass * body.mass * Eigen::Matrix3d::Identity();
  return out;
}

dynamics::BodyMotion MonolithicStepper::Part::motion(double weight, bool corrected, bool shifted,
                                                     double rate_factor, const Vector6& frame_rate,
                                                     const Vector* nodal_rate) const {
  dynamics::BodyMotion out;
  Vector6 way = weight * u;
  if (shifted) way += frame_history.offset;
  if (corrected) way += kappa;
  out.frame.X_WB.p = before->frame.X_WB.p + way.tail<3>();
  out.frame.X_WB.q = (before->frame.X_WB.q * spatial::exp_rotation(way.head<3>())).normalized();
  const Vector6 rate = rate_factor * u + frame_rate;
  out.frame.w = rate.head<3>();
  out.frame.v = rate.tail<3>();
  if (!is_flexible()) return out;
  Vector d = before->d.whole() + weight * delta;
  if (shifted) d += nodal_history.offset;
  if (corrected) d += eta;
  out.y = body.flexible->rows * d;
  out.y_dot = body.flexible->rows * (rate_factor * delta + *nodal_rate);
  return out;
}

}  // namespace buckens::verification
