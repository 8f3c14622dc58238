// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_iteration.h"

#include <cmath>

#include "buckens/body/body_lengths.h"
#include "buckens/dynamics/frame_equation.h"

namespace buckens::stepping {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Inverse of W restricted to the span of the basis, zero elsewhere.
Matrix3d restricted_inverse(const Matrix3d& W,
                            const Eigen::Matrix<double, 3, Eigen::Dynamic>& basis) {
  if (basis.cols() == 3) return W.inverse();
  if (basis.cols() == 0) return Matrix3d::Zero();
  if (basis.cols() == 1) {
    const Vector3d axis = basis.col(0);
    return axis * axis.transpose() / axis.dot(W * axis);
  }
  const Eigen::Matrix<double, 3, 2> two = basis;
  const Eigen::Matrix2d reduced = two.transpose() * W * two;
  return two * reduced.inverse() * two.transpose();
}

double largest(const Vector3d& x) { return x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

/// Rotations count by the length L.
double size_of(const Vector6& u, double L) {
  return larger(L * largest(u.head<3>()), largest(u.tail<3>()));
}

/// Per row y = N d what makes it a displacement; c_ab·d counts by m L.
linalg::Vector lengths_of_rows(const body::Body& body, Eigen::Index rows, double L) {
  linalg::Vector out(rows);
  const Eigen::VectorXd interface = body::interface_lengths(body, L);
  out.head(interface.size()) = interface;
  out.tail(rows - interface.size()).setConstant(1.0 / (body.mass * body.length_scale()));
  return out;
}

/// W⁻¹ f: rotations and translations apart.
Vector6 frame_answer(const Eigen::Matrix<double, 6, 6>& compliance, const Vector6& f) {
  Vector6 out;
  out.head<3>().noalias() = compliance.topLeftCorner<3, 3>() * f.head<3>();
  out.tail<3>().noalias() = compliance.bottomRightCorner<3, 3>() * f.tail<3>();
  return out;
}

}  // namespace

double larger(double a, double b) { return b > a || std::isnan(b) ? b : a; }

BodyIteration::BodyIteration(const body::Body& body, const BodyAnswer* answer, const Scheme& scheme,
                             double L)
    : body_(&body), answer_(answer), scheme_(scheme), L_(L) {
  translation_ =
      body.translation_basis * body.translation_basis.transpose() / (scheme.mass * body.mass);
  const Eigen::Index rows = answer != nullptr ? answer->num_rows() : 0;
  if (rows > 0) row_lengths_ = lengths_of_rows(body, rows, L);
  for (linalg::Vector* v : {&y_moving, &y_correcting, &change_}) v->setZero(rows);
}

Eigen::Matrix<double, 6, 6> BodyIteration::frame_compliance(
    const BodyStep& step, const dynamics::BodyMotion& motion) const {
  const body::DeformedMoments moments = step.moments(*body_, motion);
  const Matrix3d W = scheme_.mass * (moments.J + body_->stand_in) +
                     scheme_.damping * dynamics::gyroscopic_tangent(moments, motion.frame.w);
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  out.topLeftCorner<3, 3>() = restricted_inverse(W, body_->rotation_basis);
  out.bottomRightCorner<3, 3>() = translation_;
  return out;
}

void BodyIteration::find_residual(const BodyStep& step, const dynamics::BodyMotion& motion,
                                  const Vector6& frame_load) {
  const Vector6 acceleration = step.frame_acceleration(scheme_);
  const Vector3d w_dot = acceleration.head<3>();
  const Vector3d& w = motion.frame.w;
  Vector6 inertia;
  if (answer_ == nullptr) {
    inertia.head<3>() = body_->J0 * w_dot + w.cross(body_->J0 * w);
    inertia.tail<3>() = body_->mass * acceleration.tail<3>();
  } else {
    inertia = dynamics::frame_inertia(*body_, step.moments(*body_, motion), w, w_dot,
                                      acceleration.tail<3>());
  }
  residual_u = frame_answer(step.compliance, scheme_.force * (frame_load - inertia));
  if (answer_ == nullptr) return;
  y_moving = step.y_free - step.y_end;
  const SmallBodyAnswers& small = answer_->small_answers();
  if (!small.empty()) {
    if (answer_->corrects_outside()) {
      small.add(scheme_.force, step.load, y_moving);
    } else {
      small.add(scheme_.force, step.load, step.correction_load, y_moving);
    }
    return;
  }
  y_moving.noalias() += scheme_.force * (answer_->compliance() * step.load);
  if (!answer_->corrects_outside())
    y_moving.noalias() += answer_->correction_answer() * step.correction_load;
}

double BodyIteration::interface_change(const linalg::Vector& dy) const {
  return dy.cwiseProduct(row_lengths_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

double BodyIteration::residual_size() const {
  const double frame = size_of(residual_u, L_);
  if (answer_ == nullptr || y_moving.size() == 0) return frame;
  return larger(frame, interface_change(y_moving));
}

void BodyIteration::answer_correction(const BodyStep& step, dynamics::BodyResponse& correction) {
  correction_u = frame_answer(step.compliance, correction.frame_load);
  if (answer_ == nullptr) return;
  // Frames alone close what a changed deformation opens.
  if (answer_->is_quasi_static()) correction.interface_load.setZero();
  if (!answer_->small_answers().empty()) {
    answer_->small_answers().correct(correction.interface_load, y_correcting, y_moving);
    return;
  }
  y_correcting.noalias() = answer_->compliance() * correction.interface_load;
  if (!answer_->corrects_outside()) {
    y_moving.noalias() += answer_->correction_answer() * correction.interface_load;
  }
}

double BodyIteration::size_of_correction(const BodyStep& step,
                                         const dynamics::BodyResponse& correction) const {
  return size_of(frame_answer(step.compliance, correction.frame_load), L_);
}

BodyIteration::Moved BodyIteration::advance(BodyStep& step,
                                            const dynamics::BodyResponse& correction,
                                            const dynamics::BodyResponse& response) {
  Moved out;
  const Vector6 du = residual_u + frame_answer(step.compliance, response.frame_load);
  step.u += du;
  step.correction += correction_u;
  out.frame = size_of(du, L_) + size_of(correction_u, L_);
  out.motion = size_of(step.u, L_);
  if (answer_ == nullptr || step.y_end.size() == 0) return out;
  change_ = y_moving;
  if (answer_->small_answers().empty()) {
    change_.noalias() += answer_->compliance() * response.interface_load;
  } else {
    answer_->small_answers().add(1.0, response.interface_load, change_);
  }
  step.y_end += change_;
  step.correction_load += correction.interface_load;
  step.y_correction += y_correcting;
  out.interface = interface_change(change_);
  return out;
}

}  // namespace buckens::stepping
