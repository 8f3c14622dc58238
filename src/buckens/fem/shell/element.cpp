// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/element.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/shell/strain.h"

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

ShellStrainField strain_field(const ShellElement& element, bool with_corners = false) {
  return element.is_triangle() ? triangle_strain(element, with_corners)
                               : quadrilateral_strain(element, with_corners);
}

/// Stiffness over outer and inner variables.
struct FullStiffness {
  ShellMatrix outer;
  Eigen::Matrix<double, 4, 4> inner;
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 24> mixed;  // inner rows
};

FullStiffness full_stiffness(const ShellElement& element, const ShellStrainField& field) {
  const Eigen::Index n = element.num_variables();
  FullStiffness K{ShellMatrix::Zero(n, n), Eigen::Matrix4d::Zero(),
                  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 24>::Zero(4, n)};
  const Elastic C = elasticity(*element.stiffness);
  for (const ShellStrainPoint& at : field.points) {
    const ShellStrain stress = at.area * C * at.outer;
    const Eigen::Matrix<double, 8, 4> inner_stress = at.area * C * at.inner;
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
Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 24> inner_motion(const FullStiffness& K,
                                                                Eigen::Index count) {
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 24> out(4, K.outer.cols());
  out.setZero();
  const Eigen::MatrixXd inner = K.inner.topLeftCorner(count, count);
  out.topRows(count) = -inner.llt().solve(Eigen::MatrixXd(K.mixed.topRows(count)));
  return out;
}

}  // namespace

ShellElement shell_element(const ShellBlock& block, const std::vector<Node>& nodes, int element) {
  const ShellSection& section = block.shell_section(element);
  return {block.positions(nodes, element), block.directors(nodes, element), section.offset,
          &section, &block.stiffness(element)};
}

ShellShape shell_shape(bool is_triangle, double r, double s) {
  ShellShape out;
  if (is_triangle) {
    out.N.resize(3);
    out.N << 1 - r - s, r, s;
    out.slope.resize(2, 3);
    out.slope << -1, 1, 0, -1, 0, 1;
    return out;
  }
  out.N.resize(4);
  out.N << (1 - r) * (1 - s), (1 + r) * (1 - s), (1 + r) * (1 + s), (1 - r) * (1 + s);
  out.N *= 0.25;
  out.slope.resize(2, 4);
  out.slope << -(1 - s), 1 - s, 1 + s, -(1 + s), -(1 - r), -(1 + r), 1 + r, 1 - r;
  out.slope *= 0.25;
  return out;
}

std::vector<ShellRulePoint> shell_rule(bool is_triangle, int n) {
  const LineRule first = gauss_jacobi(n, is_triangle ? 1 : 0), second = gauss_jacobi(n, 0);
  std::vector<ShellRulePoint> out;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double weight = first.weight[i] * second.weight[j];
      if (is_triangle) {
        const double r = 0.5 * (1 + first.place[i]);
        out.push_back({r, 0.5 * (1 + second.place[j]) * (1 - r), weight / 8});
      } else {
        out.push_back({first.place[i], second.place[j], weight});
      }
    }
  }
  return out;
}

std::vector<ShellRulePoint> triangle_rule_of_degree_4() {
  std::vector<ShellRulePoint> out;
  const auto add = [&out](double b, double weight) {  // area coordinates 1 − 2b, b, b
    out.push_back({b, b, 0.5 * weight});
    out.push_back({1 - 2 * b, b, 0.5 * weight});
    out.push_back({b, 1 - 2 * b, 0.5 * weight});
  };
  add(0.44594849091596488632, 0.22338158967801146570);
  add(0.09157621350977074346, 0.10995174365532186764);
  return out;
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
  const ShellStrainField field = strain_field(element);
  const FullStiffness K = full_stiffness(element, field);
  return {field.centre.outer + field.centre.inner * inner_motion(K, field.num_inner),
          field.centre_axes};
}

std::vector<ShellStrainRows> shell_corner_strains(const ShellElement& element) {
  const ShellStrainField field = strain_field(element, true);
  const auto inner = inner_motion(full_stiffness(element, field), field.num_inner);
  std::vector<ShellStrainRows> out;
  for (std::size_t k = 0; k < field.corners.size(); ++k) {
    out.push_back({field.corners[k].outer + field.corners[k].inner * inner, field.corner_axes[k]});
  }
  return out;
}

std::vector<Matrix3d> shell_corner_axes(const ShellElement& element) {
  constexpr std::array<std::array<double, 2>, 4> square = {
      {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  std::vector<Matrix3d> out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(element.nodes.cols()); ++k) {
    // The tangents of a triangle are the same everywhere.
    const ShellShape shape = shell_shape(element.is_triangle(), square[k][0], square[k][1]);
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
  if (element.is_triangle()) {
    const TriangleDrilling drilling = triangle_drilling(element);
    for (const ShellRow& row : drilling.rows) add(row, drilling.area / 3);
  } else {
    for (const ShellStrainPoint& at : quadrilateral_strain(element).points) {
      add(at.drilling, at.area);
    }
  }
  return M;
}

}  // namespace buckens::fem
