// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/point/point_mass_block.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// u for the six variables of one node.
ShapePolynomial<6> translation_field() {
  ShapePolynomial<6> field;
  field.terms[0].leftCols<3>().setIdentity();
  return field;
}

/// θ × e, a point at unit distance along e.
ShapePolynomial<6> rotation_field(const Vector3d& e) {
  ShapePolynomial<6> field;
  for (int axis = 0; axis < 3; ++axis) field.terms[0].col(3 + axis) = Vector3d::Unit(axis).cross(e);
  return field;
}

}  // namespace

int PointMassBlock::add(int node, double mass, const Matrix3d& inertia) {
  elements_.push_back({node, mass, inertia});
  return num_elements() - 1;
}

void PointMassBlock::check(const MeshView& mesh) const {
  for (const Element& element : elements_) {
    const std::string where = fmt::format("mass at {}", node_label(mesh.nodes, element.node));
    if (!(element.mass >= 0.0)) {
      throw ModelError(
          fmt::format("{}: the mass is {:g} kg; it must not be negative", where, element.mass));
    }
    if (element.inertia.isZero(0.0)) continue;
    const double size = element.inertia.norm();
    const Vector3d principal = spatial::principal_axes(element.inertia).values;
    if (!element.inertia.isApprox(element.inertia.transpose(), 1e-12) ||
        !(principal.minCoeff() >= -1e-12 * size)) {
      throw ModelError(where + ": the inertia must be symmetric without negative principal values");
    }
    const auto& dofs = mesh.dofs.node_dofs[static_cast<std::size_t>(element.node)];
    if (std::all_of(dofs.begin() + 3, dofs.end(), [](int dof) { return dof < 0; })) {
      throw ModelError(
          where +
          ": the node has no rotations, since only bars or solids meet there; give the "
          "mass without inertia, or join a beam to the node");
    }
  }
}

void PointMassBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (const Element& element : elements_) {
    sum.mass += element.mass;
    sum.first += element.mass * nodes[static_cast<std::size_t>(element.node)].position;
  }
}

void PointMassBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (const Element& element : elements_) {
    const auto node = static_cast<std::size_t>(element.node);
    ElementInertia<6> inertia;
    inertia.add(element.mass, translation_field(), {mesh.nodes[node].position - com, {0, 0, 0}});
    if (!element.inertia.isZero(0.0)) {
      const Matrix3d second =
          0.5 * element.inertia.trace() * Matrix3d::Identity() - element.inertia;
      const spatial::PrincipalAxes principal = spatial::principal_axes(second);
      for (int k = 0; k < 3; ++k) {
        const Vector3d e = principal.vectors.col(k);
        inertia.add(principal.values[k], rotation_field(e), {e, Vector3d::Zero()});
      }
    }
    inertia.symmetrise();
    scatter<6>(inertia, mesh.dofs.node_dofs[node], sum);
  }
}

void PointMassBlock::add_stiffness(const MeshView& /*mesh*/, StiffnessSum& /*sum*/) const {}

void PointMassBlock::add_force_rows(const MeshView& /*mesh*/, int /*first_element*/,
                                    std::vector<linalg::Triplet>& /*rows*/) const {}

PointRows PointMassBlock::point_rows(const MeshView& mesh, int element, double /*xi*/) const {
  const auto node = static_cast<std::size_t>(at(element).node);
  PointRows rows;
  rows.position = mesh.nodes[node].position;
  scatter<6>(translation_field().terms[0], mesh.dofs.node_dofs[node], rows.translation);
  return rows;
}

}  // namespace buckens::fem
