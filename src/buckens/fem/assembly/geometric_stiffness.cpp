// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/geometric_stiffness.h"

#include "buckens/fem/element/block.h"
#include "buckens/fem/line/frame.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

namespace {

/// Geometric stiffness per unit axial force. It is the same in both bending planes, so only the
/// direction t of the element matters: across it act the translations u − t(t·u), and the slope of
/// the deflection is θ × t.
Matrix12 unit_stiffness(const Vector3d& t, double length, bool bends) {
  const Matrix3d across = Matrix3d::Identity() - t * t.transpose();
  Matrix12 G = Matrix12::Zero();
  const double translation = bends ? 6.0 / (5.0 * length) : 1.0 / length;
  G.block<3, 3>(0, 0) = G.block<3, 3>(6, 6) = translation * across;
  G.block<3, 3>(0, 6) = G.block<3, 3>(6, 0) = -translation * across;
  if (!bends) return G;
  Matrix3d slope;  // θ × t
  slope << 0.0, t.z(), -t.y(), -t.z(), 0.0, t.x(), t.y(), -t.x(), 0.0;
  for (const int rotation : {3, 9}) {
    G.block<3, 3>(0, rotation) = 0.1 * slope;
    G.block<3, 3>(6, rotation) = -0.1 * slope;
    G.block<3, 3>(rotation, 0) = 0.1 * slope.transpose();
    G.block<3, 3>(rotation, 6) = -0.1 * slope.transpose();
    G.block<3, 3>(rotation, rotation) = 2.0 * length / 15.0 * across;
  }
  G.block<3, 3>(3, 9) = G.block<3, 3>(9, 3) = -length / 30.0 * across;
  return G;
}

}  // namespace

GeometricStiffness::GeometricStiffness(const FeModel& fe) : size_(fe.dofs.num_dofs) {
  for (const auto& block : fe.blocks) {
    for (int e = 0; block->is_line() && e < block->num_elements(); ++e) {
      const std::array<int, 2> ends = block->ends(e);
      const auto a = static_cast<std::size_t>(ends[0]);
      const auto b = static_cast<std::size_t>(ends[1]);
      const LineFrame frame = line_frame(fe.nodes[a].position, fe.nodes[b].position, std::nullopt);
      const Vector3d t = frame.axes.col(0);
      Element element;
      for (std::size_t k = 0; k < 6; ++k) {
        element.dofs[k] = fe.dofs.node_dofs[a][k];
        element.dofs[6 + k] = fe.dofs.node_dofs[b][k];
      }
      element.axial = block->axial_rigidity(e) / frame.length * t;
      element.G = unit_stiffness(t, frame.length, block->has_rotations());
      elements_.push_back(element);
    }
  }
}

double GeometricStiffness::axial_force(const Element& element, const linalg::Vector& d) const {
  double force = 0.0;
  for (int k = 0; k < 3; ++k) {
    const int first = element.dofs[static_cast<std::size_t>(k)];
    const int second = element.dofs[static_cast<std::size_t>(6 + k)];
    if (first >= 0) force -= element.axial[k] * d[first];
    if (second >= 0) force += element.axial[k] * d[second];
  }
  return force;
}

linalg::Vector GeometricStiffness::load(const linalg::Vector& d) const {
  linalg::Vector out = linalg::Vector::Zero(size_);
  for (const Element& element : elements_) {
    Eigen::Matrix<double, 12, 1> own;
    for (int k = 0; k < 12; ++k) {
      const int dof = element.dofs[static_cast<std::size_t>(k)];
      own[k] = dof >= 0 ? d[dof] : 0.0;
    }
    const Eigen::Matrix<double, 12, 1> force = -axial_force(element, d) * (element.G * own);
    for (int k = 0; k < 12; ++k) {
      const int dof = element.dofs[static_cast<std::size_t>(k)];
      if (dof >= 0) out[dof] += force[k];
    }
  }
  return out;
}

linalg::Vector GeometricStiffness::axial_forces(const linalg::Vector& d) const {
  linalg::Vector out(static_cast<Eigen::Index>(elements_.size()));
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    out[static_cast<Eigen::Index>(e)] = axial_force(elements_[e], d);
  }
  return out;
}

linalg::SparseMatrix GeometricStiffness::matrix(const linalg::Vector& axial_forces) const {
  std::vector<linalg::Triplet> entries;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const double force = axial_forces[static_cast<Eigen::Index>(e)];
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) {
        const int row = element.dofs[static_cast<std::size_t>(i)];
        const int column = element.dofs[static_cast<std::size_t>(j)];
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, force * element.G(i, j));
      }
    }
  }
  linalg::SparseMatrix out(size_, size_);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace buckens::fem
