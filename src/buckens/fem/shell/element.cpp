// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/element.h"

#include <cmath>

#include <Eigen/Geometry>

#include "buckens/fem/shell/quadratic.h"
#include "buckens/fem/shell/strain.h"
#include "buckens/linalg/dense_cholesky.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Tangents = Eigen::Matrix<double, 3, 2>;

namespace {

// A direction counts as normal to the shell below this sine.
constexpr double kNormal = 2e-3;

using Elastic = Eigen::Matrix<double, 8, 8>;

Elastic elasticity(const ShellStiffness& s) {
  Elastic C = Elastic::Zero();
  C.topLeftCorner<3, 3>() = s.A;
  C.block<3, 3>(0, 3) = C.block<3, 3>(3, 0) = s.B;
  C.block<3, 3>(3, 3) = s.D;
  C.bottomRightCorner<2, 2>() = s.H;
  return C;
}

ShellStrainField strain_field(const ShellElement& element,
                              ShellStrainPlaces places = ShellStrainPlaces::none) {
  if (element.is_quadratic()) return quadratic_strain(element, places);
  const bool with_corners = places == ShellStrainPlaces::nodes;
  return element.is_triangle() ? triangle_strain(element, with_corners)
                               : quadrilateral_strain(element, with_corners);
}

/// Inner rows over the nodal variables.
using InnerRows =
    Eigen::Matrix<double, kMostInner, Eigen::Dynamic, 0, kMostInner, 6 * kMostShellNodes>;

/// Stiffness over outer and inner variables.
struct FullStiffness {
  ShellMatrix outer;
  Eigen::Matrix<double, kMostInner, kMostInner> inner;
  InnerRows mixed;
};

FullStiffness full_stiffness(const ShellElement& element, const ShellStrainField& field) {
  const Eigen::Index n = element.num_variables();
  FullStiffness K{ShellMatrix::Zero(n, n), Eigen::Matrix<double, kMostInner, kMostInner>::Zero(),
                  InnerRows::Zero(kMostInner, n)};
  const Elastic C = elasticity(*element.stiffness);
  for (const ShellStrainPoint& at : field.points) {
    const ShellStrain stress = at.area * C * at.outer;
    const Eigen::Matrix<double, 8, kMostInner> inner_stress = at.area * C * at.inner;
    K.outer.noalias() += at.outer.transpose() * stress;
    K.mixed.noalias() += at.inner.transpose() * stress;
    K.inner.noalias() += at.inner.transpose() * inner_stress;
    if (at.drilling.size() == 0) continue;
    const double tie = at.area * field.drilling_share * element.stiffness->shear();
    K.outer.noalias() += tie * at.drilling.transpose() * at.drilling;
    K.mixed.noalias() += tie * at.inner_drilling.transpose() * at.drilling;
    K.inner.noalias() += tie * at.inner_drilling.transpose() * at.inner_drilling;
  }
  return K;
}

/// Inner variables at rest per outer ones.
InnerRows inner_motion(const FullStiffness& K, Eigen::Index count) {
  InnerRows out = InnerRows::Zero(kMostInner, K.outer.cols());
  const Eigen::MatrixXd inner = K.inner.topLeftCorner(count, count);
  out.topRows(count) = -linalg::DenseCholesky(inner).solve(Eigen::MatrixXd(K.mixed.topRows(count)));
  return out;
}

}  // namespace

ShellElement shell_element(const ShellBlock& block, const std::vector<Node>& nodes, int element) {
  const ShellSection& section = block.shell_section(element);
  return {block.positions(nodes, element), block.directors(nodes, element), section.offset,
          &section, &block.stiffness(element)};
}

Matrix3d shell_axes(const ShellElement& element, const Tangents& tangents) {
  const Vector3d normal = tangents.col(0).cross(tangents.col(1)).normalized();
  const ShellSection& section = *element.section;
  const auto project = [&normal](const Vector3d& v) -> Vector3d {
    return v - v.dot(normal) * normal;
  };
  Vector3d x;
  if (section.direction) {
    x = project(section.direction->normalized());
  } else if (section.along_first_side) {
    x = project(element.nodes.col(1) - element.nodes.col(0)).normalized();
  } else {
    x = project(Vector3d::UnitX());
    if (x.norm() < kNormal) x = project(Vector3d::UnitZ());
  }
  x.normalize();
  Matrix3d out;
  out << x, normal.cross(x), normal;
  return out;
}

double shell_area(const ShellElement& element, const ShellShape& shape) {
  const Tangents tangents = element.middle() * shape.slope.transpose();
  return tangents.col(0).cross(tangents.col(1)).norm();
}

ShellMatrix shell_stiffness_matrix(const ShellElement& element) {
  const ShellStrainField field = strain_field(element);
  const FullStiffness K = full_stiffness(element, field);
  ShellMatrix out = K.outer + K.mixed.transpose() * inner_motion(K, field.num_inner);
  return 0.5 * (out + out.transpose());
}

ShellStrainRows shell_centre_strain(const ShellElement& element) {
  const ShellStrainField field = strain_field(element, ShellStrainPlaces::centre);
  const FullStiffness K = full_stiffness(element, field);
  return {field.centre.outer + field.centre.inner * inner_motion(K, field.num_inner),
          field.centre_axes};
}

std::vector<ShellStrainRows> shell_corner_strains(const ShellElement& element) {
  const ShellStrainField field = strain_field(element, ShellStrainPlaces::nodes);
  const auto inner = inner_motion(full_stiffness(element, field), field.num_inner);
  std::vector<ShellStrainRows> out;
  for (std::size_t k = 0; k < field.corners.size(); ++k) {
    out.push_back({field.corners[k].outer + field.corners[k].inner * inner, field.corner_axes[k]});
  }
  return out;
}

std::vector<Matrix3d> shell_corner_axes(const ShellElement& element) {
  std::vector<Matrix3d> out;
  for (const auto& [r, s] : shell_node_places(element.nodes.cols())) {
    const ShellShape shape = shell_shape(element.nodes.cols(), r, s);
    const Tangents tangents = element.middle() * shape.slope.transpose();
    out.push_back(shell_axes(element, tangents));
  }
  return out;
}

ShellMatrix shell_drilling_inertia(const ShellElement& element) {
  const double h = element.stiffness->thickness;
  const double inertia = element.stiffness->inertia[0] * h * h / 12;
  const Eigen::Index n = element.num_variables();
  ShellMatrix M = ShellMatrix::Zero(n, n);
  if (inertia == 0.0) return M;
  const auto add = [&](const ShellRow& row, double area) {
    M.noalias() += (inertia * area) * row.transpose() * row;
  };
  if (element.nodes.cols() == 3) {
    const TriangleDrilling drilling = triangle_drilling(element);
    for (const ShellRow& row : drilling.rows) add(row, drilling.area / 3);
  } else {
    for (const ShellStrainPoint& at : strain_field(element).points) {
      add(at.drilling, at.area);
    }
  }
  return M;
}

}  // namespace buckens::fem
