// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/fem/element/material.h"
#include "buckens/fem/line/beam_block.h"
#include "buckens/fem/shell/section.h"

namespace buckens::fem {

// Calls visit(number) for all that matrices of elements depend on, in a fixed order. A visitor may
// set what it gets: optional parts and lists then get the size that they have there.

template <class Derived, class Visitor>
void visit_numbers(Eigen::PlainObjectBase<Derived>& matrix, Visitor& visit) {
  for (Eigen::Index k = 0; k < matrix.size(); ++k) visit(matrix.data()[k]);
}

template <std::size_t N, class Visitor>
void visit_numbers(std::array<double, N>& numbers, Visitor& visit) {
  for (double& number : numbers) visit(number);
}

template <class Visitor>
void visit_numbers(std::optional<Eigen::Vector3d>& direction, Visitor& visit) {
  bool is_given = direction.has_value();
  visit(is_given);
  if (!is_given) return;
  if (!direction) direction.emplace();
  visit_numbers(*direction, visit);
}

template <class Visitor>
void visit_numbers(Material& material, Visitor& visit) {
  for (double Material::*number :
       {&Material::E, &Material::nu, &Material::G, &Material::rho, &Material::damping_stiffness}) {
    visit(material.*number);
  }
  bool is_orthotropic = material.orthotropy.has_value();
  visit(is_orthotropic);
  if (!is_orthotropic) return;
  if (!material.orthotropy) material.orthotropy.emplace();
  Orthotropy& of = *material.orthotropy;
  visit_numbers(of.E, visit);
  for (double* number : {&of.nu12, &of.nu13, &of.nu23, &of.G12, &of.G13, &of.G23}) visit(*number);
  visit_numbers(of.axes, visit);
}

template <class Visitor>
void visit_numbers(Section& section, Visitor& visit) {
  for (double* number :
       {&section.A, &section.Iy, &section.Iz, &section.J, &section.shear_y, &section.shear_z}) {
    visit(*number);
  }
}

template <class Visitor>
void visit_numbers(SectionTaper& taper, Visitor& visit) {
  visit_numbers(taper.middle, visit);
  for (Quartic* along : {&taper.A, &taper.Iy, &taper.Iz}) visit_numbers(*along, visit);
  for (double* number : {&taper.per_A, &taper.per_J, &taper.per_shear_y, &taper.per_shear_z}) {
    visit(*number);
  }
  visit_numbers(taper.per_Iy, visit);
  visit_numbers(taper.per_Iz, visit);
}

/// Without a law of the section: elements have theirs.
template <class Visitor>
void visit_numbers(BeamProperties& properties, Visitor& visit) {
  visit_numbers(properties.material, visit);
  visit_numbers(properties.section, visit);
  visit(properties.theory);
  visit(properties.rotary_inertia);
  visit_numbers(properties.up, visit);
}

template <class Visitor>
void visit_numbers(ShellSection& section, Visitor& visit) {
  auto count = static_cast<int>(section.layers.size());
  visit(count);
  section.layers.resize(static_cast<std::size_t>(count));
  for (ShellLayer& layer : section.layers) {
    visit_numbers(layer.material, visit);
    visit(layer.thickness);
    visit(layer.angle);
  }
  visit(section.offset);
  visit_numbers(section.direction, visit);
  visit(section.along_first_side);
}

}  // namespace buckens::fem
