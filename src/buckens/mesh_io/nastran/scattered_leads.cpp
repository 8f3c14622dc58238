// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/scattered_leads.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace buckens::mesh_io {

namespace {

using ComponentRow = Eigen::Matrix<double, 1, 6>;

constexpr double kNoPivot = 1e-9;  // pivots, arms being of order one
constexpr double kNoTerm = 1e-14;

/// The component as a function of the body's motion. @param arm from the place of that, in its unit
ComponentRow row_of_component(const NodeComponent& component, const Eigen::Vector3d& arm) {
  ComponentRow out = ComponentRow::Zero();
  if (component.is_rotation) {
    out.tail<3>() = component.direction.transpose();
  } else {
    out << component.direction.transpose(), arm.cross(component.direction).transpose();
  }
  return out;
}

void add_component_terms(const NodeComponent& component, double factor,
                         fem::ImportedEquation& equation) {
  for (int k = 0; k < 3; ++k) {
    const double own = factor * component.direction[k];
    if (std::abs(own) <= kNoTerm * std::abs(factor)) continue;
    equation.terms.push_back({component.node, (component.is_rotation ? 3 : 0) + k, own});
  }
}

}  // namespace

bool add_led_components(const std::vector<NodeComponent>& leads,
                        const std::vector<NodeComponent>& followers,
                        const std::vector<Eigen::Vector3d>& positions, int line,
                        fem::ImportedMesh& mesh) {
  const auto place = [&](const NodeComponent& component) -> const Eigen::Vector3d& {
    return positions[static_cast<std::size_t>(component.node)];
  };
  const Eigen::Vector3d origin = place(leads.front());
  double unit = 0;  // of length, so that rotations and translations are alike
  for (const NodeComponent& lead : leads) unit = std::max(unit, (place(lead) - origin).norm());
  if (unit == 0) unit = 1;
  Eigen::Matrix<double, 6, 6> G;
  for (std::size_t k = 0; k < leads.size(); ++k) {
    const ComponentRow row = row_of_component(leads[k], (place(leads[k]) - origin) / unit);
    G.row(static_cast<Eigen::Index>(k)) = row;
  }
  Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(G.transpose());
  lu.setThreshold(kNoPivot);
  if (!lu.isInvertible()) return false;
  for (const NodeComponent& follower : followers) {
    const ComponentRow row = row_of_component(follower, (place(follower) - origin) / unit);
    const Eigen::Matrix<double, 6, 1> factors = lu.solve(row.transpose());
    fem::ImportedEquation equation;
    equation.line = line;
    add_component_terms(follower, 1.0, equation);
    for (std::size_t k = 0; k < leads.size(); ++k) {
      // Rotations in radians, translations in units of length.
      const double scale =
          (follower.is_rotation ? 1 / unit : 1.0) * (leads[k].is_rotation ? unit : 1.0);
      const double factor = factors[static_cast<Eigen::Index>(k)] * scale;
      if (std::abs(factors[static_cast<Eigen::Index>(k)]) > kNoTerm)
        add_component_terms(leads[k], -factor, equation);
    }
    mesh.equations.push_back(std::move(equation));
  }
  return true;
}

int drop_idle_rotations(const std::vector<std::size_t>& places, fem::ImportedMesh& mesh) {
  std::set<int> turning;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    if (fem::dimension_of(block.kind) < 3) turning.insert(block.nodes.begin(), block.nodes.end());
  }
  for (const fem::ImportedMass& mass : mesh.masses) {
    if (!mass.inertia.isZero(0.0)) turning.insert(mass.node);
  }
  for (const fem::ImportedAverage& average : mesh.averages) turning.insert(average.reference);
  for (const fem::ImportedRigidLink& link : mesh.rigid_links) {
    turning.insert(link.reference);
    turning.insert(link.nodes.begin(), link.nodes.end());
  }
  std::set<std::size_t> idle;
  for (const std::size_t place : places) {
    const fem::ImportedEquation::Term& first = mesh.equations[place].terms.front();
    if (first.variable > 2 && !turning.contains(first.node)) idle.insert(place);
  }
  std::vector<fem::ImportedEquation> kept;
  for (std::size_t k = 0; k < mesh.equations.size(); ++k) {
    if (!idle.contains(k)) kept.push_back(std::move(mesh.equations[k]));
  }
  mesh.equations = std::move(kept);
  return static_cast<int>(idle.size());
}

}  // namespace buckens::mesh_io
