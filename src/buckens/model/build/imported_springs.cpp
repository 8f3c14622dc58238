// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_springs.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/fem/assembly/node_rotations.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::model {

using Eigen::Vector3d;
namespace {

using Stiffness = fem::SpringBlock::Stiffness;
using Lever = Eigen::Matrix<double, 6, 12>;

/// Share of the largest stiffness that is rounding.
constexpr double kSpringRounding = 1e-12;
/// Share of the largest energy of a free rotation that is rounding of its sum.
constexpr double kNoResistance = 1e-15;

/// Motion of the spring's middle, b against a, by the twelve variables of its nodes.
Lever lever(const fem::Structure& structure, const NodeSpring& spring) {
  const auto place = [&](int node) {
    return structure.nodes[static_cast<std::size_t>(node)].position;
  };
  const Vector3d half = 0.5 * (place(spring.node_b) - place(spring.node_a));
  Lever out = Lever::Zero();
  out.leftCols<6>().diagonal().setConstant(-1.0);
  out.rightCols<6>().diagonal().setConstant(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d turned = Vector3d::Unit(axis).cross(half);
    out.col(3 + axis).head<3>() = -turned;
    out.col(9 + axis).head<3>() = -turned;
  }
  return out;
}

/// The columns of rotations that the nodes do not have.
Eigen::MatrixXd free_rotations(const Lever& all, const NodeSpring& spring,
                               const std::vector<bool>& turns) {
  Eigen::MatrixXd out(6, 0);
  for (const int first : {3, 9}) {
    const int node = first == 3 ? spring.node_a : spring.node_b;
    if (turns[static_cast<std::size_t>(node)]) continue;
    out.conservativeResize(6, out.cols() + 3);
    out.rightCols<3>() = all.middleCols<3>(first);
  }
  return out;
}

/// Whether the spring resists these motions, as fem::SpringBlock::check() asks.
bool resists(const Stiffness& S, const Lever& all, const Eigen::MatrixXd& Z) {
  if (Z.cols() == 0) return false;
  const double size = (all.transpose() * S * all).cwiseAbs().maxCoeff();
  return (all.transpose() * (S * Z)).cwiseAbs().maxCoeff() > kSpringRounding * size;
}

/// What is left of a stiffness where these motions follow: S − S Z (ZᵀSZ)⁺ ZᵀS.
Stiffness with_free_rotations(const Stiffness& S, const Eigen::MatrixXd& Z) {
  const Eigen::MatrixXd SZ = S * Z;
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(Z.transpose() * SZ);
  const Eigen::VectorXd& values = eigen.values;
  Stiffness out = S;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (!(values[k] > kNoResistance * values[values.size() - 1])) continue;
    const Eigen::Matrix<double, 6, 1> force = SZ * eigen.vectors.col(k);
    out -= force * force.transpose() / values[k];
  }
  return 0.5 * (out + out.transpose());
}

}  // namespace

std::vector<std::string> add_node_springs(const std::vector<NodeSpring>& springs,
                                          const std::string& file, fem::Structure& structure) {
  std::vector<std::string> notes;
  if (springs.empty()) return notes;
  const std::vector<bool> turns = fem::nodes_with_rotations(structure);
  int num_turning = 0, num_across = 0;
  for (const NodeSpring& spring : springs) {
    Stiffness S = spring.stiffness;
    const Lever full = lever(structure, spring);
    const Eigen::MatrixXd Z = free_rotations(full, spring, turns);
    if (resists(S, full, Z)) {
      const Stiffness all = S;
      S = with_free_rotations(all, Z);
      // What rounding leaves of a stiffness that is gone would be a weak spring.
      for (int first : {0, 3}) {
        const double own = all.block<3, 3>(first, first).cwiseAbs().maxCoeff();
        if (S.block<3, 3>(first, first).cwiseAbs().maxCoeff() > 1e3 * kSpringRounding * own)
          continue;
        S.middleRows<3>(first).setZero();
        S.middleCols<3>(first).setZero();
      }
      ++num_turning;
      const double before = all.topLeftCorner<3, 3>().norm();
      if ((S - all).topLeftCorner<3, 3>().norm() > 1e-9 * before) ++num_across;
    }
    structure.springs.add(spring.node_a, spring.node_b, S);
  }
  if (num_turning > 0) {
    notes.push_back(fmt::format(
        "{}: {} springs act on the rotations of nodes of solids or bars, which have none; these "
        "nodes follow without moment{}",
        file, num_turning,
        num_across == 0
            ? std::string()
            : fmt::format(", which makes {} of the springs softer transverse to their line",
                          num_across)));
  }
  return notes;
}

}  // namespace buckens::model
