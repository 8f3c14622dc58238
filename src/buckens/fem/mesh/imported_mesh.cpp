// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/imported_mesh.h"

#include <cmath>

namespace buckens::fem {

namespace {

void scale(MaterialSpec& material, double stress, double density) {
  material.E *= stress;
  if (material.G) *material.G *= stress;
  material.rho *= density;
  if (!material.orthotropic) return;
  OrthotropicSpec& o = *material.orthotropic;
  for (double* modulus : {&o.E1, &o.E2, &o.E3, &o.G12, &o.G13, &o.G23}) *modulus *= stress;
}

struct SectionScale {
  double length;

  void operator()(CircleSpec& s) const { s.diameter *= length; }
  void operator()(TubeSpec& s) const {
    s.outer_diameter *= length;
    if (s.inner_diameter) *s.inner_diameter *= length;
    if (s.thickness) *s.thickness *= length;
  }
  void operator()(RectangleSpec& s) const {
    s.width *= length;
    s.height *= length;
  }
  void operator()(BoxSpec& s) const {
    s.width *= length;
    s.height *= length;
    s.thickness *= length;
  }
  void operator()(GeneralSectionSpec& s) const {
    s.A *= length * length;
    for (double* moment : {&s.Iy, &s.Iz, &s.J}) *moment *= std::pow(length, 4);
    for (auto& point : s.stress_points) {
      for (double& coordinate : point) coordinate *= length;
    }
  }
};

void scale(ImportedProperty& property, double length) {
  if (property.thickness) *property.thickness *= length;
  property.offset *= length;
  for (ImportedLayer& layer : property.layers) layer.thickness *= length;
  if (property.section) std::visit(SectionScale{length}, property.section->shape);
}

void scale(ImportedSpring& spring, double length, double mass) {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const int rotations = (row > 2 ? 1 : 0) + (column > 2 ? 1 : 0);
      spring.stiffness(row, column) *= mass * std::pow(length, rotations);
    }
  }
}

/// A translation grows with the unit of length, a rotation does not.
void scale(ImportedEquation& equation, double length) {
  for (ImportedEquation::Term& term : equation.terms) {
    if (term.variable < 3) term.coefficient /= length;
  }
}

}  // namespace

int ImportedMesh::num_elements() const {
  int count = 0;
  for (const ImportedBlock& block : blocks) count += block.num_elements();
  return count;
}

ImportedMesh in_si(ImportedMesh mesh, double length, double mass) {
  for (Eigen::Vector3d& position : mesh.positions) position *= length;
  for (MaterialSpec& material : mesh.materials) {
    scale(material, mass / length, mass / std::pow(length, 3));
  }
  for (ImportedProperty& property : mesh.properties) scale(property, length);
  for (ImportedMass& point : mesh.masses) {
    point.mass *= mass;
    point.inertia *= mass * length * length;
    point.offset *= length;
  }
  for (ImportedSpring& spring : mesh.springs) scale(spring, length, mass);
  for (ImportedEquation& equation : mesh.equations) scale(equation, length);
  return mesh;
}

}  // namespace buckens::fem
