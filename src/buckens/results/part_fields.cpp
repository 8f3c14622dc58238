// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/part_fields.h"

#include <numeric>
#include <span>

#include "buckens/fem/element/block.h"

namespace buckens::results {

using Eigen::Index;
using fem::TensorColumns;

namespace {

// A reduced body's recovery is multiplied with its basis up to this many bytes.
constexpr double kMostBasisBytes = 1e9;

}  // namespace

/// Nodes of the whole mesh that the nodes of a part are, −1 where that is unknown.
std::vector<int> whole_nodes_of(const model::Model& model, const model::WholeBody& whole,
                                int body) {
  const fem::FeModel& mesh = model.bodies[static_cast<std::size_t>(body)].flexible->mesh();
  std::vector<int> out(mesh.nodes.size(), -1);
  if (!whole.is_divided()) {
    std::iota(out.begin(), out.end(), 0);
    return out;
  }
  for (std::size_t n = 0; n < whole.nodes.size(); ++n) {
    const model::MeshCopy& copy = whole.nodes[n];
    if (copy.body == body) out[static_cast<std::size_t>(copy.index)] = static_cast<int>(n);
  }
  // Further copies of a node show in the elements, whose nodes have the same order in both meshes.
  std::vector<std::span<const int>> of_part, of_whole;
  const auto collect = [](const fem::FeModel& fe, std::vector<std::span<const int>>& list) {
    for (const auto& block : fe.blocks) {
      // Shells are counted behind the solids, and their block follows.
      const bool is_counted = block->is_solid() || block->is_shell();
      for (int e = 0; is_counted && e < block->num_elements(); ++e) {
        list.push_back(block->nodes(e));
      }
    }
  };
  collect(mesh, of_part);
  collect(*whole.mesh, of_whole);
  for (std::size_t e = 0; e < whole.solids.size(); ++e) {
    if (whole.solids[e].body != body) continue;
    const auto own = of_part[static_cast<std::size_t>(whole.solids[e].index)];
    for (std::size_t k = 0; k < own.size(); ++k) {
      out[static_cast<std::size_t>(own[k])] = of_whole[e][k];
    }
  }
  return out;
}

void PartFields::compose(const body::FlexiblePart& flexible, bool has_motion) {
  if (!flexible.recovery.is_dense()) return;
  const linalg::Matrix& Z = flexible.recovery.dense();
  const double rows = (strains ? 6.0 * static_cast<double>(num_places() + num_elements()) : 0.0) +
                      6.0 * static_cast<double>(shell_columns.size()) +
                      (has_motion ? 3.0 * static_cast<double>(num_places()) : 0.0);
  if (rows * static_cast<double>(Z.cols()) * sizeof(double) > kMostBasisBytes) return;
  if (shells) shell_basis = shells->rows() * Z;
  if (strains) {
    node_basis.resize(6 * strains->num_places(), Z.cols());
    element_basis.resize(6 * num_elements(), Z.cols());
    TensorColumns at_nodes, at_elements;
    for (Index k = 0; k < Z.cols(); ++k) {
      strains->evaluate(Z.col(k), at_nodes, at_elements);
      node_basis.col(k) = at_nodes.reshaped();
      element_basis.col(k) = at_elements.reshaped();
    }
  }
  if (!has_motion) return;
  motion_basis.resize(3 * num_places(), Z.cols());
  for (Index p = 0; p < num_places(); ++p) {
    const auto node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(p)]);
    for (int c = 0; c < 3; ++c) {
      const int dof = flexible.mesh().dofs.node_dofs[node][static_cast<std::size_t>(c)];
      if (dof >= 0) {
        motion_basis.row(3 * p + c) = Z.row(dof);
      } else {
        motion_basis.row(3 * p + c).setZero();
      }
    }
  }
}

void PartFields::evaluate(const body::FlexiblePart& flexible, const linalg::Vector& d,
                          TensorColumns& at_nodes, TensorColumns& at_elements,
                          TaskPool* pool) const {
  if (node_basis.cols() == 0) {
    strains->evaluate(flexible.nodal(d), at_nodes, at_elements, pool);
    return;
  }
  at_nodes.resize(6, strains->num_places());
  at_elements.resize(6, num_elements());
  at_nodes.reshaped().noalias() = node_basis * d;
  at_elements.reshaped().noalias() = element_basis * d;
}

fem::ShellNodeStresses::Surface PartFields::evaluate_shells(const body::FlexiblePart& flexible,
                                                            const linalg::Vector& d) const {
  TensorColumns strain(6, static_cast<Index>(shell_columns.size()));
  if (shell_basis.cols() > 0) {
    strain.reshaped().noalias() = shell_basis * d;
  } else {
    strain.reshaped().noalias() = shells->rows() * flexible.nodal(d);
  }
  return shells->surface(strain);
}

Index PartFields::place_of(int node, int element) const {
  if (element < first_shell || !shells) return strains->place_of(node, element);
  const int place = shells->place_of(node, element - first_shell);
  return place < 0 ? -1 : shell_columns[static_cast<std::size_t>(place)];
}

Eigen::Matrix3Xd PartFields::translations(const body::FlexiblePart& flexible,
                                          const linalg::Vector& d) const {
  Eigen::Matrix3Xd out(3, num_places());
  if (motion_basis.cols() > 0) {
    out.reshaped().noalias() = motion_basis * d;
    return out;
  }
  const linalg::Vector nodal = flexible.nodal(d);
  for (Index p = 0; p < num_places(); ++p) {
    const auto node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(p)]);
    for (int c = 0; c < 3; ++c) {
      const int dof = flexible.mesh().dofs.node_dofs[node][static_cast<std::size_t>(c)];
      out(c, p) = dof >= 0 ? nodal[dof] : 0.0;
    }
  }
  return out;
}

}  // namespace buckens::results
