// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/beam_block.h"

#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/dofs.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"

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
/// @param inertia ρ I_p l along the element
void add_flywheel(const Quartic& inertia, const Vector3d& t, const Dofs& dofs, InertiaSum& sum) {
  const Eigen::Matrix3d tt = t * t.transpose();
  Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Zero();
  double all = 0.0, linear = 0.0, square = 0.0;  // ∫ I ξᵏ dξ
  for (std::size_t k = 0; k < inertia.size(); ++k) {
    const auto power = static_cast<double>(k);
    all += inertia[k] / (power + 1.0);
    linear += inertia[k] / (power + 2.0);
    square += inertia[k] / (power + 3.0);
  }
  M.block<3, 3>(3, 3) = (all - 2.0 * linear + square) * tt;
  M.block<3, 3>(3, 9) = M.block<3, 3>(9, 3) = (linear - square) * tt;
  M.block<3, 3>(9, 9) = square * tt;
  scatter<12>(M, dofs, 1.0, sum.M_flywheel);
  sum.J0_flywheel += all * tt;
}

/// Calls visit(power, coefficient) for what is not zero.
template <class Visitor>
void visit_terms(const Quartic& p, Visitor&& visit) {
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (p[k] != 0.0) visit(static_cast<int>(k), p[k]);
  }
}

/// Polar moments from those about both axes.
Quartic polar_moments(double factor, const Quartic& Iy, const Quartic& Iz) {
  Quartic out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = factor * (Iy[k] + Iz[k]);
  return out;
}

}  // namespace

int BeamBlock::add_properties(BeamProperties properties) {
  properties_.push_back(std::move(properties));
  return static_cast<int>(properties_.size()) - 1;
}

int BeamBlock::add(int node_a, int node_b, int properties, const BeamPortion& portion) {
  if (properties < 0 || properties >= static_cast<int>(properties_.size())) {
    throw ModelError(fmt::format("beam: there are no properties number {}", properties));
  }
  const SectionLaw& law = properties_[static_cast<std::size_t>(properties)].taper;
  if (!law) return add(node_a, node_b, properties, portion, nullptr);
  const SectionTaper own = section_taper(law, portion.from, portion.to);
  return add(node_a, node_b, properties, portion, &own);
}

int BeamBlock::add(int node_a, int node_b, int properties, const BeamPortion& portion,
                   const SectionTaper* taper) {
  elements_.push_back({{node_a, node_b},
                       properties,
                       portion,
                       taper == nullptr ? -1 : static_cast<int>(tapers_.size())});
  if (taper != nullptr) tapers_.push_back(*taper);
  return num_elements() - 1;
}

BeamBlock BeamBlock::subset(const std::vector<int>& elements,
                            const std::vector<int>& node_numbers) const {
  BeamBlock out;
  std::vector<int> number(properties_.size(), -1);
  for (const int e : elements) {
    const auto& [ends, properties, portion, taper] = at(e);
    int& own = number[static_cast<std::size_t>(properties)];
    if (own < 0) own = out.add_properties(properties_[static_cast<std::size_t>(properties)]);
    out.add(node_numbers.at(static_cast<std::size_t>(ends[0])),
            node_numbers.at(static_cast<std::size_t>(ends[1])), own, portion);
  }
  return out;
}

LineFrame BeamBlock::frame(const std::vector<Node>& nodes, const Element& element) const {
  return line_frame(nodes[static_cast<std::size_t>(element.ends[0])].position,
                    nodes[static_cast<std::size_t>(element.ends[1])].position,
                    element.portion.up ? element.portion.up : of(element).up);
}

const Section* BeamBlock::section(int element) const { return &middle(at(element)); }

const Section* BeamBlock::end_section(int element, int end) const {
  const SectionTaper* own = taper(at(element));
  if (own == nullptr) return &of(at(element)).section;
  return end == 0 ? &own->first : &own->last;
}

Eigen::Matrix3d BeamBlock::line_axes(const std::vector<Node>& nodes, int element) const {
  return frame(nodes, at(element)).axes;
}

double BeamBlock::axial_rigidity(int element) const {
  const SectionTaper* own = taper(at(element));
  const BeamProperties& beam = of(at(element));
  return own == nullptr ? beam.material.E * beam.section.A : beam.material.E / own->per_A;
}

Quartic BeamBlock::area(int element) const {
  const SectionTaper* own = taper(at(element));
  return own == nullptr ? constant_quartic(of(at(element)).section.A) : own->A;
}

BeamShape BeamBlock::shape_of(const Element& element, const LineFrame& axes) const {
  const BeamProperties& beam = of(element);
  return beam_shape(axes,
                    shear_parameters(beam.theory, beam.material, middle(element), axes.length));
}

Eigen::Matrix<double, 12, 12> BeamBlock::local_stiffness(const Element& element,
                                                         double length) const {
  const BeamProperties& beam = of(element);
  if (const SectionTaper* own = taper(element)) {
    return beam_stiffness_local(beam.theory, beam.material, *own, length);
  }
  return beam_stiffness_local(beam.material, beam.section, length,
                              shear_parameters(beam.theory, beam.material, beam.section, length));
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
    const Material& material = of(element).material;
    const Section& section = middle(element);
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
    if (of(element).theory == BeamTheory::timoshenko &&
        !(section.shear_y > 0.0 && section.shear_z > 0.0)) {
      throw ModelError(where + ": the shear factors of a Timoshenko beam must be positive");
    }
  }
}

void BeamBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (const Element& element : elements_) {
    const Vector3d& a = nodes[static_cast<std::size_t>(element.ends[0])].position;
    const Vector3d& b = nodes[static_cast<std::size_t>(element.ends[1])].position;
    const double rho_l = of(element).material.rho * (b - a).norm();
    const SectionTaper* own = taper(element);
    const Quartic A = own != nullptr ? own->A : constant_quartic(of(element).section.A);
    visit_terms(A, [&](int power, double value) {
      const double mass = rho_l * value / (power + 1.0);
      const double share = (power + 1.0) / (power + 2.0);
      sum.mass += mass;
      sum.first += mass * ((1.0 - share) * a + share * b);
    });
  }
}

void BeamBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (const Element& element : elements_) {
    const Material& material = of(element).material;
    if (material.rho == 0.0) continue;
    const LineFrame axes = frame(mesh.nodes, element);
    const BeamShape shape = shape_of(element, axes);
    const Dofs dofs = element_dofs<6>(mesh.dofs, element.ends);
    const double rho_l = material.rho * axes.length;
    const SectionTaper* own = taper(element);
    const Section& section = of(element).section;
    const Quartic A = own != nullptr ? own->A : constant_quartic(section.A);
    const Quartic Iy = own != nullptr ? own->Iy : constant_quartic(section.Iy);
    const Quartic Iz = own != nullptr ? own->Iz : constant_quartic(section.Iz);
    const Vector3d t = axes.axes.col(0);
    const Vector3d start = mesh.nodes[static_cast<std::size_t>(element.ends[0])].position - com;

    Inertia inertia;
    const auto add = [&](const Quartic& density, const ShapePolynomial<12>& field,
                         const LinePosition& place) {
      visit_terms(density, [&](int power, double value) {
        inertia.add(rho_l * value, field, place, power);
      });
    };
    add(A, shape.displacement, {start, axes.length * t});
    if (of(element).rotary_inertia) {
      const Vector3d y = axes.axes.col(1);
      const Vector3d z = axes.axes.col(2);
      add(Iz, section_field(shape.rotation, y), {y, Vector3d::Zero()});
      add(Iy, section_field(shape.rotation, z), {z, Vector3d::Zero()});
    } else {
      add_flywheel(polar_moments(rho_l, Iy, Iz), t, dofs, sum);
    }
    inertia.symmetrise();
    scatter<12>(inertia, dofs, sum);
  }
}

void BeamBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  for (const Element& element : elements_) {
    const Material& material = of(element).material;
    const LineFrame axes = frame(mesh.nodes, element);
    const Eigen::Matrix<double, 12, 12> T = beam_rotation(axes.axes);
    Eigen::Matrix<double, 12, 12> K = T * local_stiffness(element, axes.length) * T.transpose();
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
    const LineFrame axes = frame(mesh.nodes, element);
    Eigen::Matrix<double, 12, 12> forces =
        local_stiffness(element, axes.length) * beam_rotation(axes.axes).transpose();
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
  const LineFrame axes = frame(mesh.nodes, beam);
  const BeamShape shape = shape_of(beam, axes);
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
