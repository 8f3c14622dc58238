// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/bar_block.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/dofs.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"
#include "buckens/fem/line/frame.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using BarDofs = std::array<int, 6>;

ShapePolynomial<6> linear_shape() {
  ShapePolynomial<6> shape;
  shape.degree = 1;
  shape.terms[0].leftCols<3>().setIdentity();
  shape.terms[1].leftCols<3>() = -Eigen::Matrix3d::Identity();
  shape.terms[1].rightCols<3>().setIdentity();
  return shape;
}

struct Line {
  Vector3d start;
  Vector3d along;
  double length;
  Vector3d direction;
};

Line line(const std::vector<Node>& nodes, const std::array<int, 2>& ends) {
  const Vector3d& a = nodes[static_cast<std::size_t>(ends[0])].position;
  const Vector3d along = nodes[static_cast<std::size_t>(ends[1])].position - a;
  return {a, along, along.norm(), along.normalized()};
}

}  // namespace

int BarBlock::add(int node_a, int node_b, const Material& material, const Section& section) {
  elements_.push_back({{node_a, node_b}, material, section});
  return num_elements() - 1;
}

Eigen::Matrix3d BarBlock::line_axes(const std::vector<Node>& nodes, int element) const {
  const auto& [a, b] = at(element).ends;
  return line_frame(nodes[static_cast<std::size_t>(a)].position,
                    nodes[static_cast<std::size_t>(b)].position, std::nullopt)
      .axes;
}

BarBlock BarBlock::subset(const std::vector<int>& elements,
                          const std::vector<int>& node_numbers) const {
  BarBlock out;
  for (const int e : elements) {
    const Element& bar = at(e);
    out.add(node_numbers.at(static_cast<std::size_t>(bar.ends[0])),
            node_numbers.at(static_cast<std::size_t>(bar.ends[1])), bar.material, bar.section);
  }
  return out;
}

void BarBlock::check(const MeshView& mesh) const {
  for (const Element& element : elements_) {
    const std::string where =
        fmt::format("bar between {} and {}", node_label(mesh.nodes, element.ends[0]),
                    node_label(mesh.nodes, element.ends[1]));
    const Line at = line(mesh.nodes, element.ends);
    try {
      line_frame(at.start, at.start + at.along, std::nullopt);
    } catch (const ModelError& error) {
      throw ModelError(where + ": " + error.what());
    }
    refuse_orthotropic(where, element.material);
    if (!(element.material.E > 0.0 && element.section.A > 0.0 && element.material.rho >= 0.0)) {
      throw ModelError(fmt::format(
          "{}: E = {:g} Pa, A = {:g} m², rho = {:g} kg/m³; all must be positive (rho may be zero)",
          where, element.material.E, element.section.A, element.material.rho));
    }
  }
}

void BarBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (const Element& element : elements_) {
    const Line at = line(nodes, element.ends);
    const double mass = element.material.rho * element.section.A * at.length;
    sum.mass += mass;
    sum.first += mass * (at.start + 0.5 * at.along);
  }
}

void BarBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  const ShapePolynomial<6> shape = linear_shape();
  for (const Element& element : elements_) {
    const Line at = line(mesh.nodes, element.ends);
    const double mass = element.material.rho * element.section.A * at.length;
    if (mass == 0.0) continue;
    ElementInertia<6> inertia;
    inertia.add(mass, shape, {at.start - com, at.along});
    inertia.symmetrise();
    scatter<6>(inertia, element_dofs<3>(mesh.dofs, element.ends), sum);
  }
}

void BarBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  for (const Element& element : elements_) {
    const Line at = line(mesh.nodes, element.ends);
    Eigen::Matrix<double, 6, 1> strain;
    strain << -at.direction, at.direction;
    const double stiffness = element.material.E * element.section.A / at.length;
    Eigen::Matrix<double, 6, 6> K = strain * strain.transpose();
    K *= stiffness;  // after the product, so that rounding stays symmetric
    const BarDofs dofs = element_dofs<3>(mesh.dofs, element.ends);
    scatter<6>(K, dofs, 1.0, sum.K);
    if (element.material.damping_stiffness != 0.0) {
      scatter<6>(K, dofs, element.material.damping_stiffness, sum.K_damping);
    }
  }
}

void BarBlock::add_force_rows(const MeshView& mesh, int first_element,
                              std::vector<linalg::Triplet>& rows) const {
  int row = 12 * first_element;
  for (const Element& element : elements_) {
    const Line at = line(mesh.nodes, element.ends);
    const double stiffness = element.material.E * element.section.A / at.length;
    const BarDofs dofs = element_dofs<3>(mesh.dofs, element.ends);
    for (int j = 0; j < 6; ++j) {
      const int column = dofs[static_cast<std::size_t>(j)];
      const double value = (j < 3 ? -stiffness : stiffness) * at.direction[j % 3];
      if (column < 0 || value == 0.0) continue;
      rows.emplace_back(row, column, value);
      rows.emplace_back(row + 6, column, value);
    }
    row += 12;
  }
}

PointRows BarBlock::point_rows(const MeshView& mesh, int element, double xi) const {
  const Element& bar = at(element);
  const Line place = line(mesh.nodes, bar.ends);
  PointRows rows;
  rows.position = place.start + xi * place.along;
  scatter<6>(linear_shape().at(xi), element_dofs<3>(mesh.dofs, bar.ends), rows.translation);
  return rows;
}

}  // namespace buckens::fem
