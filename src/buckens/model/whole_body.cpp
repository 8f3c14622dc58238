// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/whole_body.h"

#include <Eigen/SVD>

#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/spatial/rotation.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// The rotation nearest to B in the sense of least squares.
Matrix3d nearest_rotation(const Matrix3d& B) {
  const Eigen::JacobiSVD<Matrix3d> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d sign = Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

}  // namespace

body::FrameMotion whole_motion(const Model& model, const WholeBody& whole, const State& state) {
  const auto first = static_cast<std::size_t>(whole.first);
  if (!whole.is_divided()) return state.bodies[first].frame;
  const std::size_t end = first + static_cast<std::size_t>(whole.count);

  body::FrameMotion out;
  for (std::size_t b = first; b < end; ++b) {
    const double share = model.bodies[b].mass / whole.mass;
    out.X_WB.p += share * state.bodies[b].frame.X_WB.p;
    out.v += share * state.bodies[b].frame.v;
  }
  Matrix3d B = Matrix3d::Zero();
  Matrix3d J = Matrix3d::Zero();
  Vector3d momentum = Vector3d::Zero();
  for (std::size_t b = first; b < end; ++b) {
    const body::Body& part = model.bodies[b];
    const body::FrameMotion& frame = state.bodies[b].frame;
    const Matrix3d R = frame.X_WB.R();
    const Vector3d r0 = part.com - whole.com;
    const Vector3d r = frame.X_WB.p - out.X_WB.p;
    // ∫ s sᵀ dm of the part in its own axes; what is in J0 alone turns the frame no less.
    const Matrix3d second = 0.5 * part.J0.trace() * Matrix3d::Identity() - part.J0;
    B += part.mass * r * r0.transpose() + R * second;
    const Matrix3d skew = spatial::skew(r);
    J += R * part.J0 * R.transpose() - part.mass * skew * skew;
    momentum += R * (part.J0 * frame.w) + part.mass * r.cross(frame.v - out.v);
  }
  const Matrix3d R = nearest_rotation(B);
  out.X_WB.q = Eigen::Quaterniond(R).normalized();
  // Straight bars have no inertia about their axis: the least rotation that has the momentum.
  out.w = R.transpose() * spatial::spin_of(J, momentum);
  return out;
}

}  // namespace buckens::model
