// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/rigid_regions.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/second_moments.h"

namespace buckens::body {

using Eigen::Vector3d;
using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

/// Region of each node, −1: none.
std::vector<int> regions_of_nodes(const std::string& body, std::size_t num_nodes,
                                  const std::vector<RigidRegion>& regions) {
  std::vector<int> out(num_nodes, -1);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    for (const int node : regions[k].nodes) {
      int& owner = out.at(static_cast<std::size_t>(node));
      if (owner < 0) {
        owner = static_cast<int>(k);
        continue;
      }
      const RigidRegion& first = regions[static_cast<std::size_t>(owner)];
      const auto common =
          std::count_if(regions[k].nodes.begin(), regions[k].nodes.end(), [&](int n) {
            return std::find(first.nodes.begin(), first.nodes.end(), n) != first.nodes.end();
          });
      throw ModelError(fmt::format(
          "body \"{}\": its rigid interfaces \"{}\" ({} nodes) and \"{}\" ({} nodes) have {} nodes "
          "in common, which cannot move with both; make one of them `average`, or join them to one",
          body, first.name, first.nodes.size(), regions[k].name, regions[k].nodes.size(), common));
    }
  }
  return out;
}

/// Nodes and variables after the elimination, and the way back.
class Elimination {
 public:
  Elimination(const fem::FeModel& full, const std::vector<RigidRegion>& regions,
              const std::vector<int>& region_of)
      : full_(full), regions_(regions), region_of_(region_of), nodes_(full.nodes) {
    number();
    make_map();
  }

  const std::vector<fem::Node>& nodes() const { return nodes_; }
  const fem::DofMap& dofs() const { return dofs_; }
  const SparseMatrix& T() const { return T_; }
  /// TᵀAT.
  SparseMatrix condensed(const SparseMatrix& A) const {
    if (A.nonZeros() == 0) return SparseMatrix(T_.cols(), T_.cols());
    const SparseMatrix AT = A * T_;
    return T_.transpose() * AT;
  }
  /// Component `axis` of the displacements of all nodes, a row each.
  SparseMatrix component(std::size_t axis) const {
    std::vector<Triplet> entries;
    for (std::size_t node = 0; node < full_.nodes.size(); ++node) {
      const int dof = full_.dofs.node_dofs[node][axis];
      if (dof >= 0) entries.emplace_back(static_cast<int>(node), dof, 1.0);
    }
    SparseMatrix pick(static_cast<Eigen::Index>(full_.nodes.size()), T_.rows());
    pick.setFromTriplets(entries.begin(), entries.end());
    return pick * T_;
  }

 private:
  /// Free nodes keep their variables; those of the regions come last.
  void number() {
    std::array<int, 6> none{};
    none.fill(-1);
    dofs_.node_dofs.assign(full_.nodes.size(), none);
    for (std::size_t node = 0; node < full_.nodes.size(); ++node) {
      if (region_of_[node] >= 0) continue;
      for (std::size_t k = 0; k < 6; ++k) {
        if (full_.dofs.node_dofs[node][k] >= 0) dofs_.node_dofs[node][k] = dofs_.num_dofs++;
      }
    }
    for (const RigidRegion& region : regions_) {
      nodes_.push_back({region.name, region.centre});
      auto& own = dofs_.node_dofs.emplace_back();
      for (int& dof : own) dof = dofs_.num_dofs++;
    }
  }

  void make_map() {
    std::vector<Triplet> entries;
    for (std::size_t node = 0; node < full_.nodes.size(); ++node) {
      const auto& from = full_.dofs.node_dofs[node];
      if (region_of_[node] < 0) {
        const auto& to = dofs_.node_dofs[node];
        for (std::size_t k = 0; k < 6; ++k) {
          if (from[k] >= 0) entries.emplace_back(from[k], to[k], 1.0);
        }
      } else {
        follow(node, entries);
      }
    }
    T_.resize(full_.dofs.num_dofs, dofs_.num_dofs);
    T_.setFromTriplets(entries.begin(), entries.end());
  }

  /// u_i = u + θ × r.
  void follow(std::size_t node, std::vector<Triplet>& entries) const {
    const auto region = static_cast<std::size_t>(region_of_[node]);
    const auto& from = full_.dofs.node_dofs[node];
    const auto& to = dofs_.node_dofs[full_.nodes.size() + region];
    const Vector3d r = full_.nodes[node].position - regions_[region].centre;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector3d turned = Vector3d::Unit(static_cast<Eigen::Index>(axis)).cross(r);
      if (from[axis] >= 0) entries.emplace_back(from[axis], to[axis], 1.0);
      if (from[3 + axis] >= 0) entries.emplace_back(from[3 + axis], to[3 + axis], 1.0);
      for (std::size_t k = 0; k < 3; ++k) {
        const double arm = turned[static_cast<Eigen::Index>(k)];
        if (from[k] >= 0 && arm != 0.0) entries.emplace_back(from[k], to[3 + axis], arm);
      }
    }
  }

  const fem::FeModel& full_;
  const std::vector<RigidRegion>& regions_;
  const std::vector<int>& region_of_;
  std::vector<fem::Node> nodes_;
  fem::DofMap dofs_;
  SparseMatrix T_;
};

/// Splits the scalar mass matrix: entries between free nodes stay, all others become W_ab.
void condense_nodal_mass(const fem::NodalMass& full, const Elimination& elimination,
                         const std::vector<int>& region_of, fem::ShapeIntegrals& out) {
  std::vector<Triplet> kept, taken;
  for (int column = 0; column < full.Ms.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(full.Ms, column); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      const bool is_free = region_of[row] < 0 && region_of[static_cast<std::size_t>(column)] < 0;
      (is_free ? kept : taken).emplace_back(static_cast<int>(it.row()), column, it.value());
    }
  }
  const auto num_nodes = static_cast<Eigen::Index>(elimination.nodes().size());
  out.nodal.Ms.resize(num_nodes, num_nodes);
  out.nodal.Ms.setFromTriplets(kept.begin(), kept.end());
  for (const auto& node : elimination.dofs().node_dofs) {
    out.nodal.dofs.push_back({node[0], node[1], node[2]});
  }
  SparseMatrix rest(full.Ms.rows(), full.Ms.cols());
  rest.setFromTriplets(taken.begin(), taken.end());
  std::array<SparseMatrix, 3> weighted, own;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    own[axis] = elimination.component(axis);
    weighted[axis] = rest * own[axis];
  }
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto a = static_cast<std::size_t>(kPairs[k][0]);
    const auto b = static_cast<std::size_t>(kPairs[k][1]);
    const SparseMatrix transposed = own[a].transpose();
    out.W[k] += SparseMatrix(transposed * weighted[b]);
  }
}

fem::ShapeIntegrals condensed(const fem::ShapeIntegrals& full, const Elimination& elimination,
                              const std::vector<int>& region_of) {
  fem::ShapeIntegrals out;
  out.mass = full.mass;
  out.com = full.com;
  out.C0 = full.C0;
  out.J0 = full.J0;
  out.c = elimination.T().transpose() * full.c;
  for (std::size_t k = 0; k < out.W.size(); ++k) out.W[k] = elimination.condensed(full.W[k]);
  if (full.nodal.Ms.nonZeros() > 0) {
    condense_nodal_mass(full.nodal, elimination, region_of, out);
  }
  return out;
}

}  // namespace

std::unique_ptr<FlexiblePart> with_rigid_regions(const std::string& body, FlexiblePart& part,
                                                 const std::vector<RigidRegion>& regions) {
  auto full = std::make_shared<const fem::FeModel>(std::move(part.fe));
  const std::vector<int> region_of = regions_of_nodes(body, full->nodes.size(), regions);
  const Elimination elimination(*full, regions, region_of);
  fem::FeModel fe;
  fe.nodes = elimination.nodes();
  fe.dofs = elimination.dofs();
  fe.M = elimination.condensed(full->M);
  fe.K = elimination.condensed(full->K);
  fe.K_damping = elimination.condensed(full->K_damping);
  fe.mass_damping = full->mass_damping;
  fe.shape = condensed(full->shape, elimination, region_of);
  auto out = std::make_unique<FlexiblePart>(body, std::move(fe), part.coupling);
  out->full_mesh = std::move(full);
  out->recovery = NodalRecovery(elimination.T());
  return out;
}

}  // namespace buckens::body
