// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/divided_body.h"

#include "buckens/fem/solid/recovery.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

void push_vector(const Vector3d& v, std::vector<double>& values) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

}  // namespace

const body::FrameMotion& DividedBody::frame(const Observation& now) const {
  return now.wholes[static_cast<std::size_t>(&whole_ - model_.wholes.data())];
}

Vector3d DividedBody::place(const model::MarkerId& id) const {
  const body::Body& part = model_.bodies[static_cast<std::size_t>(id.body)];
  return part.markers[static_cast<std::size_t>(id.marker)].X_BF.p + part.com - whole_.com;
}

Vector3d DividedBody::displacement(const Observation& now, const model::MarkerId& id) const {
  const spatial::Pose& X = frame(now).X_WB;
  const Vector3d p = dynamics::evaluate_marker(now.model, id, now.motions).motion.p;
  return X.q.conjugate() * (p - X.p) - place(id);
}

void DividedBody::append_displacements(const Observation& now, std::vector<double>& values) const {
  const spatial::Pose& X = frame(now).X_WB;
  const Quaterniond to_whole = X.q.conjugate();
  for (std::size_t n = 0; n < whole_.nodes.size(); ++n) {
    const model::MeshCopy& copy = whole_.nodes[n];
    const auto b = static_cast<std::size_t>(copy.body);
    const body::Body& part = model_.bodies[b];
    const model::BodyState& s = now.state.bodies[b];
    const auto& dofs = part.flexible->mesh().dofs.node_dofs[static_cast<std::size_t>(copy.index)];
    Eigen::Matrix<double, 6, 1> own = Eigen::Matrix<double, 6, 1>::Zero();
    bool turns = false;
    for (int k = 0; k < 6; ++k) {
      const int dof = dofs[static_cast<std::size_t>(k)];
      if (dof < 0) continue;
      own[k] = now.nodal[b][dof];
      turns = turns || k >= 3;
    }
    const Vector3d& at = whole_.mesh->nodes[n].position;
    const Vector3d p = s.frame.X_WB * Vector3d(at - part.com + own.head<3>());
    push_vector(to_whole * (p - X.p) - (at - whole_.com), values);
    const Quaterniond turned =
        to_whole * s.frame.X_WB.q * spatial::exp_rotation(Vector3d(own.tail<3>()));
    push_vector(turns ? spatial::log_rotation(turned) : Vector3d(Vector3d::Zero()), values);
  }
}

void DividedBody::append_elements(const std::vector<linalg::Matrix>& tables,
                                  std::vector<double>& values) const {
  for (const model::MeshCopy& copy : whole_.lines) {
    const auto column = tables[static_cast<std::size_t>(copy.body)].col(copy.index);
    values.insert(values.end(), column.data(), column.data() + column.size());
  }
}

void DividedBody::append_solid_stresses(const std::vector<linalg::Matrix>& tables,
                                        std::vector<double>& values) const {
  for (const model::MeshCopy& copy : whole_.solids) {
    values.push_back(tables[static_cast<std::size_t>(copy.body)](fem::kMises, copy.index));
  }
}

std::vector<std::size_t> DividedBody::ties() const {
  std::vector<std::size_t> out;
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const model::Joint& joint = model_.joints[j];
    const int from_first = joint.first.body - whole_.first;
    if (joint.is_tie && from_first >= 0 && from_first < whole_.count) out.push_back(j);
  }
  return out;
}

void DividedBody::append_cut_forces(const Observation& now, std::vector<double>& values) const {
  for (const std::size_t j : ties()) {
    const auto lower = static_cast<std::size_t>(model_.joints[j].first.body);
    const Quaterniond to_part = now.state.bodies[lower].frame.X_WB.q.conjugate();
    push_vector(to_part * now.joint_wrenches[j].force, values);
    push_vector(to_part * now.joint_wrenches[j].torque, values);
  }
}

}  // namespace buckens::results
