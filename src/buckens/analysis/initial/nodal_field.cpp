// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/nodal_field.h"

#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;

Vector nodal_field(const body::Body& part, const std::array<const model::PositionLaw*, 6>& laws) {
  const fem::FeModel& fe = part.flexible->mesh();
  Vector out = Vector::Zero(fe.M.rows());
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[node][k];
      if (dof >= 0) out[dof] = (*laws[k])(fe.nodes[node].position);
    }
  }
  return part.flexible->coordinates(out);
}

std::vector<RigidShare> sieve_field(const model::Model& model, const model::WholeBody& whole,
                                    std::vector<Vector>& fields) {
  std::vector<RigidShare> shares(fields.size());
  const auto part = [&](std::size_t k) -> const body::Body& {
    return model.bodies[static_cast<std::size_t>(whole.first) + k];
  };
  Vector3d momentum = Vector3d::Zero();
  Vector3d spin_momentum = Vector3d::Zero();
  Matrix3d J = Matrix3d::Zero();
  for (std::size_t k = 0; whole.is_divided() && k < fields.size(); ++k) {
    const auto mean = part(k).flexible->sieve.rigid_part(fields[k]);
    const Vector3d r = part(k).com - whole.com;
    shares[k] = {mean.head<3>(), mean.tail<3>()};
    momentum += part(k).mass * mean.head<3>();
    spin_momentum += part(k).J0 * mean.tail<3>() + part(k).mass * r.cross(mean.head<3>());
    const Matrix3d skew = spatial::skew(r);
    J += part(k).J0 - part(k).mass * skew * skew;
  }
  for (std::size_t k = 0; k < fields.size(); ++k) part(k).flexible->sieve.apply(fields[k]);
  if (!whole.is_divided()) return shares;
  const Vector3d v0 = momentum / whole.mass;
  const Vector3d w0 = spatial::spin_of(J, spin_momentum);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    shares[k].translation -= v0 + w0.cross(part(k).com - whole.com);
    shares[k].rotation -= w0;
  }
  return shares;
}

}  // namespace buckens::analysis
