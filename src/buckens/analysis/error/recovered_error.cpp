// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/recovered_error.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/strains.h"

namespace buckens::analysis {

namespace {

/// Nodal variables of displacements; rotations stay zero, solids have none.
linalg::Vector nodal_variables(const fem::FeModel& mesh, const linalg::Matrix& displacements) {
  linalg::Vector out = linalg::Vector::Zero(mesh.dofs.num_dofs);
  for (std::size_t node = 0; node < mesh.dofs.node_dofs.size(); ++node) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int dof = mesh.dofs.node_dofs[node][c];
      if (dof >= 0) {
        out[dof] = displacements(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(c));
      }
    }
  }
  return out;
}

std::vector<int> nodes_of_solids(const fem::FeModel& mesh) {
  std::vector<int> out;
  for (const auto& block : mesh.blocks) {
    if (!block->is_solid()) continue;
    for (int e = 0; e < block->num_elements(); ++e) {
      const auto nodes = block->nodes(e);
      out.insert(out.end(), nodes.begin(), nodes.end());
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void scale(fem::MaterialSpec& material, double factor) {
  material.E *= factor;
  if (material.G) *material.G *= factor;
  if (!material.orthotropic) return;
  fem::OrthotropicSpec& o = *material.orthotropic;
  for (double* modulus : {&o.E1, &o.E2, &o.E3, &o.G12, &o.G13, &o.G23}) *modulus *= factor;
}

}  // namespace

std::optional<double> recovered_error(const fem::FeModel& mesh,
                                      const linalg::Matrix& displacements) {
  const std::vector<int> nodes = nodes_of_solids(mesh);
  if (nodes.empty()) return std::nullopt;
  const linalg::Vector d = nodal_variables(mesh, displacements);
  const fem::SolidStrains strains(mesh, nodes, {});
  fem::TensorColumns at_places, at_elements;
  strains.evaluate(d, at_places, at_elements);
  const fem::EnergyOfError found = strains.energy_of_error(d, at_places);
  if (!(found.energy > 0.0)) return std::nullopt;
  return found.error / (found.energy + found.error);
}

bool scale_moduli(body::BodySpec& spec, double factor) {
  auto* mesh = std::get_if<fem::MeshSpec>(&spec.kind);
  if (mesh == nullptr || !mesh->is_file() || !mesh->imported) return false;
  if (mesh->material) scale(mesh->material->value, factor);
  for (fem::GroupMaterialSpec& group : mesh->materials) scale(group.material.value, factor);
  auto imported = std::make_shared<fem::ImportedMesh>(*mesh->imported);
  for (fem::MaterialSpec& material : imported->materials) scale(material, factor);
  mesh->imported = std::move(imported);
  return true;
}

}  // namespace buckens::analysis
