// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

using body::Marker;
using body::MarkerKinematics;

namespace {

const Marker& marker_of(const model::Model& model, const model::MarkerId& id) {
  return model.bodies[static_cast<std::size_t>(id.body)]
      .markers[static_cast<std::size_t>(id.marker)];
}

BodyRow body_row(const model::Model& model, const model::MarkerId& id, const MarkerKinematics& k,
                 const Eigen::Matrix<double, 1, 6>& J) {
  BodyRow row;
  row.body = id.body;
  if (id.body == model::kGround) return row;
  // A scalar with derivative J is the work of the wrench J on the marker.
  const spatial::Wrench unit{J.head<3>().transpose(), J.tail<3>().transpose()};
  row.frame = k.frame_load(unit).transpose();
  const Marker& marker = marker_of(model, id);
  row.translation_row = marker.translation_row;
  row.rotation_row = marker.rotation_row;
  if (marker.follows_mesh()) row.interface = k.interface_load(unit).transpose();
  return row;
}

}  // namespace

double BodyRow::rate(const BodyMotion& motion) const {
  if (body == model::kGround) return 0.0;
  Eigen::Matrix<double, 6, 1> twist;
  twist << motion.frame.w, motion.frame.v;
  return change(twist, motion.y_dot);
}

double BodyRow::change(const Eigen::Matrix<double, 6, 1>& u, const Eigen::VectorXd& y) const {
  if (body == model::kGround) return 0.0;
  double out = frame.dot(u);
  if (translation_row >= 0) out += interface.head<3>().dot(y.segment<3>(translation_row));
  if (rotation_row >= 0) out += interface.tail<3>().dot(y.segment<3>(rotation_row));
  return out;
}

MarkerKinematics evaluate_marker(const model::Model& model, const model::MarkerId& id,
                                 const std::vector<BodyMotion>& motions) {
  if (id.body == model::kGround) {
    MarkerKinematics k;
    k.motion.p = id.X_WF.p;
    k.motion.R = id.X_WF.R();
    k.R_WB.setIdentity();
    k.z.setZero();
    k.rotation_map.setIdentity();
    return k;
  }
  const BodyMotion& motion = motions[static_cast<std::size_t>(id.body)];
  return body::marker_kinematics(marker_of(model, id), motion.frame, motion.y, motion.y_dot);
}

spatial::MarkerBias evaluate_bias(const model::Model& model, const model::MarkerId& id,
                                  const std::vector<BodyMotion>& motions) {
  if (id.body == model::kGround) return {};
  const BodyMotion& motion = motions[static_cast<std::size_t>(id.body)];
  return body::marker_bias(marker_of(model, id), motion.frame, motion.y, motion.y_dot);
}

SystemRow system_row(const model::Model& model, const model::MarkerId& first,
                     const MarkerKinematics& first_kinematics, const model::MarkerId& second,
                     const MarkerKinematics& second_kinematics, const spatial::PairRow& J) {
  return {body_row(model, first, first_kinematics, J.head<6>()),
          body_row(model, second, second_kinematics, J.tail<6>()),
          {}};
}

void motion_of(const body::Body& body, const model::BodyState& s, BodyMotion& out) {
  out.frame = s.frame;
  if (!body.is_flexible()) return;
  const std::vector<linalg::Vector> there = linalg::NodalVector::row_products({&s.d, &s.d_dot});
  if (!there.empty()) {
    out.y = there[0];
    out.y_dot = there[1];
    return;
  }
  const auto& rows = body.flexible->rows;
  out.y.noalias() = rows * s.d.whole();
  out.y_dot.noalias() = rows * s.d_dot.whole();
}

void motions_of(const model::Model& model, const model::State& state,
                std::vector<BodyMotion>& out) {
  out.resize(model.bodies.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    motion_of(model.bodies[k], state.bodies[k], out[k]);
  }
}

std::vector<BodyMotion> motions_of(const model::Model& model, const model::State& state) {
  std::vector<BodyMotion> motions;
  motions_of(model, state, motions);
  return motions;
}

}  // namespace buckens::dynamics
