// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/assemble.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/fem/assembly/inertia_assembly.h"
#include "buckens/fem/assembly/made_columns.h"
#include "buckens/fem/assembly/mesh_division.h"
#include "buckens/fem/assembly/node_rotations.h"
#include "buckens/fem/assembly/solid_inertia.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::fem {

using linalg::SparseMatrix;

namespace {

using Blocks = std::vector<std::shared_ptr<const ElementBlock>>;

// Elements of smaller meshes are summed within some 20 ms.
constexpr int kManyVariables = 3000;

/// Calls visit(nodes) for the nodes of each link, a reference node first.
template <class Visitor>
void visit_links(const NodeLinks& links, Visitor&& visit) {
  const auto with_reference = [&visit](const auto& link) {
    std::vector<int> nodes = {link.reference};
    nodes.insert(nodes.end(), link.nodes.begin(), link.nodes.end());
    visit(nodes);
  };
  for (const RigidLink& link : links.rigid) with_reference(link);
  for (const AverageLink& link : links.averages) with_reference(link);
  for (const LinearEquation& equation : links.equations) {
    std::vector<int> nodes;
    for (const LinearEquation::Term& term : equation.terms) nodes.push_back(term.node);
    visit(nodes);
  }
}

void check_node_numbers(const Structure& structure, const Blocks& blocks) {
  const int num_nodes = static_cast<int>(structure.nodes.size());
  visit_links(structure.links, [&](const std::vector<int>& nodes) {
    for (const int node : nodes) {
      if (node >= 0 && node < num_nodes) continue;
      throw ModelError(
          fmt::format("a link refers to node {}, but there are {} nodes", node, num_nodes));
    }
  });
  for (const auto& block : blocks) {
    for (int e = 0; e < block->num_elements(); ++e) {
      for (const int node : block->nodes(e)) {
        if (node >= 0 && node < num_nodes) continue;
        throw ModelError(
            fmt::format("an element refers to node {}, but there are {} nodes", node, num_nodes));
      }
    }
  }
}

/// Refuses nodes not held by elements and meshes in several pieces.
void check_connected(const std::vector<Node>& nodes, const Blocks& blocks, const NodeLinks& links) {
  std::vector<int> parent(nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<bool> used(nodes.size(), false);
  const auto root = [&parent](int node) {
    while (parent[static_cast<std::size_t>(node)] != node) {
      int& up = parent[static_cast<std::size_t>(node)];
      up = parent[static_cast<std::size_t>(up)];
      node = up;
    }
    return node;
  };
  const auto join = [&](std::span<const int> together) {
    for (const int node : together) {
      used[static_cast<std::size_t>(node)] = true;
      parent[static_cast<std::size_t>(root(node))] = root(together.front());
    }
  };
  for (const auto& block : blocks) {
    for (int e = 0; block->holds_nodes() && e < block->num_elements(); ++e) join(block->nodes(e));
  }
  visit_links(links, [&](const std::vector<int>& together) { join(together); });
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int node = static_cast<int>(k);
    if (!used[k]) {
      throw ModelError(node_label(nodes, node) +
                       " is connected to no element; remove it or join an element to it");
    }
    if (root(node) != root(0)) {
      throw ModelError(fmt::format(
          "{} and {} belong to parts that nothing holds together; join them by an element, or "
          "make two bodies",
          node_label(nodes, 0), node_label(nodes, node)));
    }
  }
}

std::array<bool, 6> kept_variables(std::optional<spatial::Plane> planar) {
  std::array<bool, 6> kept;
  kept.fill(true);
  if (!planar) return kept;
  const auto normal = static_cast<std::size_t>(spatial::normal_index(*planar));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    kept[axis] = axis != normal;
    kept[3 + axis] = axis == normal;
  }
  return kept;
}

DofMap number_dofs(const Structure& structure, const Blocks& blocks,
                   std::optional<spatial::Plane> planar) {
  const std::size_t num_nodes = structure.nodes.size();
  const std::vector<bool> turns = nodes_with_rotations(structure);
  const bool has_solids = std::any_of(blocks.begin(), blocks.end(), [](const auto& block) {
    return block->is_solid() && block->num_elements() > 0;
  });
  const std::array<bool, 6> kept = kept_variables(has_solids ? std::nullopt : planar);
  DofMap dofs;
  dofs.node_dofs.resize(num_nodes);
  for (std::size_t node = 0; node < num_nodes; ++node) {
    for (std::size_t k = 0; k < 6; ++k) {
      const bool present = kept[k] && (k < 3 || turns[node]);
      dofs.node_dofs[node][k] = present ? dofs.num_dofs++ : -1;
    }
  }
  return dofs;
}

/// α and what it acts on, common to all materials.
void set_mass_damping(FeModel& fe) {
  const Material* first = nullptr;
  for (const auto& block : fe.blocks) {
    for (int e = 0; e < block->num_elements(); ++e) {
      const Material* material = block->material(e);
      if (material == nullptr) continue;
      if (first == nullptr) first = material;
      if (first->damping_mass != material->damping_mass) {
        throw ModelError(fmt::format(
            "its materials have different mass damping, {:g} and {:g} 1/s; mass damping "
            "is one value per body",
            first->damping_mass, material->damping_mass));
      }
      if (first->damps_held_motion != material->damps_held_motion) {
        throw ModelError(
            "one of its materials is damped as the joints hold the body, another one otherwise; "
            "give the body a `damping` of its own");
      }
    }
  }
  if (first == nullptr) return;
  fe.mass_damping = first->damping_mass;
  fe.damps_held_motion = first->damps_held_motion;
}

/// Solids of a large mesh, which other processes integrate, or null; the other blocks are left.
std::shared_ptr<const ElementBlock> solids_elsewhere(Blocks& blocks, const MeshView& mesh) {
  if (!linalg::is_shared_work(mesh.dofs.num_dofs)) return {};
  const auto solids = std::find_if(blocks.begin(), blocks.end(), [](const auto& block) {
    return block->is_solid() && block->num_elements() > 0;
  });
  if (solids == blocks.end()) return {};
  auto taken = *solids;
  blocks.erase(solids);
  return taken;
}

/// @return the part of M that is not in Σ W_aa
SparseMatrix integrate_inertia(Blocks blocks, const MeshView& mesh, FeModel& fe) {
  MassMoment moment;
  // In this process: the frame is in the mass centre, and a run may go on in another number of
  // processes. There, a frame beside its place by rounding would open joints.
  for (const auto& block : blocks) {
    const MassMoment more = mass_moment(*block, mesh);
    moment.mass += more.mass;
    moment.first += more.first;
  }
  if (!(moment.mass > 0.0)) {
    throw ModelError("the mesh has no mass; give a material a density or add a point mass");
  }
  ShapeIntegrals& shape = fe.shape;
  shape.mass = moment.mass;
  shape.com = moment.first / moment.mass;

  const int n = mesh.dofs.num_dofs;
  const std::shared_ptr<const ElementBlock> solids = solids_elsewhere(blocks, mesh);
  linalg::SharedMatrix::Make again;
  AssembledInertia inertia = assemble_inertia(blocks, mesh, shape.com);
  InertiaSum& sum = inertia.sum;
  SparseMatrix& Ms = inertia.scalar_mass;
  if (solids) {
    const SolidInertia made(solid_mass_made_elsewhere(solids, mesh.nodes, fe.parts), mesh.nodes);
    made.add_moments(mesh.dofs, shape.com, sum);
    if (Ms.nonZeros() == 0) {
      Ms = made.scalar_mass();
      again = solid_mass_again(solids, mesh.nodes, fe.parts);
    } else {
      Ms += made.scalar_mass();
    }
  }
  const bool has_integrals =
      std::any_of(sum.W.begin(), sum.W.end(), [](const auto& listed) { return !listed.empty(); });
  for (std::size_t k = 0; has_integrals && k < sum.W.size(); ++k) {
    shape.W[k] = taken_matrix(n, sum.W[k]);
  }
  shape.c = std::move(sum.c);
  shape.C0 = sum.C0;
  shape.J0 = sum.C0.trace() * Eigen::Matrix3d::Identity() - sum.C0 + sum.J0_flywheel;
  if (Ms.nonZeros() > 0) {
    shape.nodal = {linalg::SharedMatrix(std::move(Ms), std::move(again)), translations(mesh.dofs)};
  }
  return taken_matrix(n, sum.M_flywheel);
}

void let_others_make(const MeshView& mesh, FeModel& fe) {
  const linalg::SharedRowOrder order = row_order(mesh.dofs, fe.parts);
  fe.M = matrix_made_elsewhere(MeshMatrix::mass, fe.blocks, mesh, order);
  fe.K = matrix_made_elsewhere(MeshMatrix::stiffness, fe.blocks, mesh, order);
  const bool is_damped = std::any_of(fe.blocks.begin(), fe.blocks.end(), [](const auto& block) {
    for (int e = 0; e < block->num_elements(); ++e) {
      const Material* material = block->material(e);
      if (material != nullptr && material->damping_stiffness != 0.0) return true;
    }
    return false;
  });
  fe.K_damping = SparseMatrix(mesh.dofs.num_dofs, mesh.dofs.num_dofs);
  if (is_damped) fe.K_damping = matrix_made_elsewhere(MeshMatrix::damping, fe.blocks, mesh, order);
}

}  // namespace

FeModel assemble(const Structure& structure, std::optional<spatial::Plane> planar) {
  FeModel fe;
  fe.blocks = {std::make_shared<BeamBlock>(structure.beams),
               std::make_shared<BarBlock>(structure.bars),
               std::make_shared<PointMassBlock>(structure.masses),
               std::make_shared<SolidBlock>(structure.solids)};
  auto shells = std::make_shared<ShellBlock>(structure.shells);
  fe.blocks.push_back(shells);
  fe.blocks.push_back(std::make_shared<SpringBlock>(structure.springs));
  check_node_numbers(structure, fe.blocks);
  check_connected(structure.nodes, fe.blocks, structure.links);
  shells->choose_directors(structure.nodes);
  fe.nodes = structure.nodes;
  fe.dofs = number_dofs(structure, fe.blocks, planar);
  const bool is_large = fe.dofs.num_dofs >= kManyVariables;
  const MeshView mesh{fe.nodes, fe.dofs, is_large ? base::AllowedThreads::pool() : nullptr};
  for (const auto& block : fe.blocks) block->check(mesh);
  if (linalg::is_shared_work(fe.dofs.num_dofs)) fe.parts = divided_nodes(fe.blocks, mesh);

  const SparseMatrix flywheel = integrate_inertia(fe.blocks, mesh, fe);
  set_mass_damping(fe);
  if (linalg::is_shared_work(fe.dofs.num_dofs)) {
    let_others_make(mesh, fe);
    return fe;
  }
  fe.M = mass_matrix(fe.shape, flywheel, fe.dofs.num_dofs);
  StiffnessMatrices stiffness = assemble_stiffness(fe.blocks, mesh);
  fe.K = linalg::SymmetricMatrix::in_blocks(std::move(stiffness.K), mesh.pool);
  fe.K_damping = linalg::SymmetricMatrix::in_blocks(std::move(stiffness.K_damping), mesh.pool);
  return fe;
}

}  // namespace buckens::fem
