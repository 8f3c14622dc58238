// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/beam_block.h"

#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/elasticity.h"
#include "buckens/fem/element_dofs.h"
#include "buckens/fem/node_label.h"
#include "buckens/fem/scatter.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using Inertia = ElementInertia<12>;
using Dofs = std::array<int, 12>;

/// The displacement θ × e of section points per unit distance along e.
ShapePolynomial<12> section_field(const ShapePolynomial<12>& rotation, const Vector3d& e) {
  ShapePolynomial<12> field;
  field.degree = rotation.degree;
  for (std::size_t k = 0; k < field.terms.size(); ++k) {
    for (int column = 0; column < 12; ++column) {
      const Vector3d theta = rotation.terms[k].col(column);
      field.terms[k].col(column) = theta.cross(e);
    }
  }
  return field;
}

/// M and J0 of the torsional flywheels ½∫ρI_p(ω·t+θ̇_x)² dx, with θ_x linear in ξ.
void add_flywheel(double inertia, const Vector3d& t, const Dofs& dofs, InertiaSum& sum) {
  Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Zero();
  const Eigen::Matrix3d tt = inertia / 6.0 * (t * t.transpose());
  M.block<3, 3>(3, 3) = M.block<3, 3>(9, 9) = 2.0 * tt;
  M.block<3, 3>(3, 9) = M.block<3, 3>(9, 3) = tt;
  scatter<12>(M, dofs, 1.0, sum.M_flywheel);
  sum.J0_flywheel += inertia * t * t.transpose();
}

}  // namespace

int BeamBlock::add_properties(BeamProperties properties) {
  properties_.push_back(std::move(properties));
  return static_cast<int>(properties_.size()) - 1;
}

int BeamBlock::add(int node_a, int node_b, int properties) {
  if (properties < 0 || properties >= static_cast<int>(properties_.size())) {
    throw ModelError(fmt::format("beam: there are no properties number {}", properties));
  }
  elements_.push_back({{node_a, node_b}, properties});
  return num_elements() - 1;
}

BeamBlock BeamBlock::subset(const std::vector<int>& elements,
                            const std::vector<int>& node_numbers) const {
  BeamBlock out;
  std::vector<int> number(properties_.size(), -1);
  for (const int e : elements) {
    const auto& [ends, properties] = at(e);
    int& own = number[static_cast<std::size_t>(properties)];
    if (own < 0) own = out.add_properties(properties_[static_cast<std::size_t>(properties)]);
    out.add(node_numbers.at(static_cast<std::size_t>(ends[0])),
            node_numbers.at(static_cast<std::size_t>(ends[1])), own);
  }
  return out;
}

LineFrame BeamBlock::frame(const std::vector<Node>& nodes, const Element& element) const {
  return line_frame(nodes[static_cast<std::size_t>(element.ends[0])].position,
                    nodes[static_cast<std::size_t>(element.ends[1])].position, of(element).up);
}

void BeamBlock::check(const MeshView& mesh) const {
  for (const Element& element : elements_) {
    const std::string where =
        fmt::format("beam between {} and {}", node_label(mesh.nodes, element.ends[0]),
                    node_label(mesh.nodes, element.ends[1]));
    try {
      frame(mesh.nodes, element);
    } catch (const ModelError& error) {
      throw ModelError(where + ": " + error.what());
    }
    const auto& [material, section, theory, rotary, up] = of(element);
    refuse_orthotropic(where, material);
    const bool elastic = material.E > 0.0 && material.G > 0.0;
    const bool solid = section.A > 0.0 && section.Iy > 0.0 && section.Iz > 0.0 && section.J > 0.0;
    if (!elastic || !solid || !(material.rho >= 0.0)) {
      throw ModelError(
          fmt::format("{}: E = {:g} Pa, G = {:g} Pa, rho = {:g} kg/m³, A = {:g} m², Iy = {:g} m⁴, "
                      "Iz = {:g} m⁴, "
                      "J = {:g} m⁴; all must be positive (rho may be zero)",
                      where, material.E, material.G, material.rho, section.A, section.Iy,
                      section.Iz, section.J));
    }
    if (theory == BeamTheory::timoshenko && !(section.shear_y > 0.0 && section.shear_z > 0.0)) {
      throw ModelError(where + ": the shear factors of a Timoshenko beam must be positive");
    }
  }
}

void BeamBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (const Element& element : elements_) {
    const Vector3d& a = nodes[static_cast<std::size_t>(element.ends[0])].position;
    const Vector3d& b = nodes[static_cast<std::size_t>(element.ends[1])].position;
    const double mass = of(element).material.rho * of(element).section.A * (b - a).norm();
    sum.mass += mass;
    sum.first += 0.5 * mass * (a + b);
  }
}

void BeamBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (const Element& element : elements_) {
    const auto& [material, section, theory, rotary, up] = of(element);
    if (material.rho == 0.0) continue;
    const LineFrame axes = frame(mesh.nodes, element);
    const BeamShape shape =
        beam_shape(axes, shear_parameters(theory, material, section, axes.length));
    const Dofs dofs = element_dofs<6>(mesh.dofs, element.ends);
    const double rho_l = material.rho * axes.length;
    const Vector3d t = axes.axes.col(0);
    const Vector3d start = mesh.nodes[static_cast<std::size_t>(element.ends[0])].position - com;

    Inertia inertia;
    inertia.add(rho_l * section.A, shape.displacement, {start, axes.length * t});
    if (rotary) {
      const Vector3d y = axes.axes.col(1);
      const Vector3d z = axes.axes.col(2);
      inertia.add(rho_l * section.Iz, section_field(shape.rotation, y), {y, Vector3d::Zero()});
      inertia.add(rho_l * section.Iy, section_field(shape.rotation, z), {z, Vector3d::Zero()});
    } else {
      add_flywheel(rho_l * section.polar_moment(), t, dofs, sum);
    }
    inertia.symmetrise();
    scatter<12>(inertia, dofs, sum);
  }
}

void BeamBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  for (const Element& element : elements_) {
    const auto& [material, section, theory, rotary, up] = of(element);
    const LineFrame axes = frame(mesh.nodes, element);
    const ShearParameters shear = shear_parameters(theory, material, section, axes.length);
    const Eigen::Matrix<double, 12, 12> T = beam_rotation(axes.axes);
    const Eigen::Matrix<double, 12, 12> local =
        beam_stiffness_local(material, section, axes.length, shear);
    Eigen::Matrix<double, 12, 12> K = T * local * T.transpose();
    K = (0.5 * (K + K.transpose())).eval();
    const Dofs dofs = element_dofs<6>(mesh.dofs, element.ends);
    scatter<12>(K, dofs, 1.0, sum.K);
    if (material.damping_stiffness != 0.0) {
      scatter<12>(K, dofs, material.damping_stiffness, sum.K_damping);
    }
  }
}

void BeamBlock::add_force_rows(const MeshView& mesh, int first_element,
                               std::vector<linalg::Triplet>& rows) const {
  int row = 12 * first_element;
  for (const Element& element : elements_) {
    const auto& [material, section, theory, rotary, up] = of(element);
    const LineFrame axes = frame(mesh.nodes, element);
    const ShearParameters shear = shear_parameters(theory, material, section, axes.length);
    Eigen::Matrix<double, 12, 12> forces =
        beam_stiffness_local(material, section, axes.length, shear) *
        beam_rotation(axes.axes).transpose();
    // The nodal force at the first end acts on the face that looks along −x.
    forces.topRows<6>() *= -1.0;
    const Dofs dofs = element_dofs<6>(mesh.dofs, element.ends);
    for (int j = 0; j < 12; ++j) {
      const int column = dofs[static_cast<std::size_t>(j)];
      for (int i = 0; i < 12 && column >= 0; ++i) {
        if (forces(i, j) != 0.0) rows.emplace_back(row + i, column, forces(i, j));
      }
    }
    row += 12;
  }
}

PointRows BeamBlock::point_rows(const MeshView& mesh, int element, double xi) const {
  const Element& beam = at(element);
  const auto& [material, section, theory, rotary, up] = of(beam);
  const LineFrame axes = frame(mesh.nodes, beam);
  const BeamShape shape =
      beam_shape(axes, shear_parameters(theory, material, section, axes.length));
  const Dofs dofs = element_dofs<6>(mesh.dofs, beam.ends);
  PointRows rows;
  rows.has_rotation = true;
  rows.position = mesh.nodes[static_cast<std::size_t>(beam.ends[0])].position +
                  xi * axes.length * axes.axes.col(0);
  scatter<12>(shape.displacement.at(xi), dofs, rows.translation);
  scatter<12>(shape.rotation.at(xi), dofs, rows.rotation);
  return rows;
}

}  // namespace buckens::fem
