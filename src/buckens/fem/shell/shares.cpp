// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/shares.h"

#include <Eigen/Geometry>

#include "buckens/fem/shell/element.h"

namespace buckens::fem {

using Eigen::Vector3d;

FaceIntegrals shell_side_integrals(const ShellBlock& shells, const std::vector<Node>& nodes,
                                   const ShellSide& side) {
  const ShellVectors x = shells.positions(nodes, side.element);
  const auto own = shells.nodes(side.element);
  const Eigen::Index count = x.cols();
  FaceIntegrals out{{own.begin(), own.end()},
                    Eigen::VectorXd::Zero(count),
                    Eigen::Matrix3Xd::Zero(3, count),
                    Eigen::MatrixXd::Zero(count, count),
                    Eigen::VectorXd::Zero(count)};
  for (const ShellRulePoint& at : shell_mass_rule(x.cols())) {
    const ShellShape shape = shell_shape(x.cols(), at.r, at.s);
    const Eigen::Matrix<double, 3, 2> tangents = x * shape.slope.transpose();
    const Vector3d normal = at.weight * tangents.col(0).cross(tangents.col(1));
    out.area += normal.norm() * shape.N;
    out.normal += (side.is_negative ? -1.0 : 1.0) * normal * shape.N.transpose();
    out.products += normal.norm() * shape.N * shape.N.transpose();
  }
  out.positive_area = out.products.diagonal() * (out.area.sum() / out.products.trace());
  return out;
}

ShellShares shell_shares(const ShellBlock& shells, const std::vector<Node>& nodes, int element,
                         bool per_mass) {
  const ShellElement shell = shell_element(shells, nodes, element);
  const auto own = shells.nodes(element);
  const double h = shell.stiffness->thickness;
  const double whole = per_mass ? shell.stiffness->inertia[0] : h;
  const double first = (per_mass ? shell.stiffness->inertia[1] : 0.0) + shell.offset * whole;
  ShellShares out{{own.begin(), own.end()},
                  Eigen::VectorXd::Zero(shell.nodes.cols()),
                  Eigen::Matrix3Xd::Zero(3, shell.nodes.cols())};
  for (const ShellRulePoint& at : shell_mass_rule(shell.nodes.cols())) {
    const ShellShape shape = shell_shape(shell.nodes.cols(), at.r, at.s);
    out.translation += at.weight * shell_area(shell, shape) * shape.N;
  }
  for (Eigen::Index i = 0; i < shell.nodes.cols(); ++i) {
    out.arm.col(i) = first * out.translation[i] * shell.directors.col(i);
  }
  out.translation *= whole;
  return out;
}

}  // namespace buckens::fem
