// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/rigid_regions.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/loose_motions.h"
#include "buckens/body/second_moments.h"
#include "buckens/fem/assembly/made_columns.h"
#include "buckens/fem/assembly/mesh_division.h"
#include "buckens/fem/constraint/elimination.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::body {

using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

void refuse_common_nodes(const std::string& body, std::size_t num_nodes,
                         const std::vector<RigidRegion>& regions) {
  std::vector<int> owners(num_nodes, -1);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    for (const int node : regions[k].nodes) {
      int& owner = owners.at(static_cast<std::size_t>(node));
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
          "in common, which cannot move with both; make one of them `average`, or merge them",
          body, first.name, first.nodes.size(), regions[k].name, regions[k].nodes.size(), common));
    }
  }
}

/// Variables that a node of the mesh can have: all, or those of the plane of a planar model.
std::array<bool, 6> known_variables(const fem::DofMap& dofs) {
  std::array<bool, 6> known{};
  for (const auto& node : dofs.node_dofs) {
    for (std::size_t k = 0; k < 3; ++k) known[k] = known[k] || node[k] >= 0;
  }
  const bool is_planar = !(known[0] && known[1] && known[2]);
  for (std::size_t k = 0; k < 3; ++k) known[3 + k] = !is_planar || !known[k];
  return known;
}

/// The mesh with one more node per region, and its links solved.
class Condensation {
 public:
  Condensation(const fem::FeModel& full, const std::vector<RigidRegion>& regions,
               fem::NodeLinks links)
      : full_(&full), nodes_(full.nodes), parts_(full.parts) {
    fem::DofMap dofs = full.dofs;
    const std::array<bool, 6> known = known_variables(full.dofs);
    for (const RigidRegion& region : regions) {
      links.rigid.push_back({fmt::format("rigid interface \"{}\"", region.name),
                             static_cast<int>(nodes_.size()), region.nodes});
      nodes_.push_back({region.name, region.centre});
      if (!parts_.empty()) {
        parts_.part.push_back(parts_.part[static_cast<std::size_t>(region.nodes.front())]);
      }
      auto& own = dofs.node_dofs.emplace_back();
      for (std::size_t k = 0; k < 6; ++k) own[k] = known[k] ? dofs.num_dofs++ : -1;
    }
    elimination_ = fem::eliminate(nodes_, dofs, links);
    T_ = elimination_.T.topRows(full.dofs.num_dofs);
    T_.makeCompressed();
    order_ = fem::row_order(elimination_.dofs, parts_);
  }

  const std::vector<fem::Node>& nodes() const { return nodes_; }
  const fem::NodeParts& parts() const { return parts_; }
  const fem::DofMap& dofs() const { return elimination_.dofs; }
  const SparseMatrix& T() const { return T_; }
  bool is_free(std::size_t node) const { return elimination_.is_free[node]; }
  /// TᵀAT.
  SparseMatrix condensed(const SparseMatrix& A) const { return fem::condensed(A, T_); }
  /// The same of a matrix of the mesh, which afterwards takes no more memory in this process:
  /// entries of one by node or in blocks do not stay, and one that is divided is not brought back.
  linalg::SymmetricMatrix condensed(fem::MeshMatrix which, const linalg::SymmetricMatrix& A) const {
    if (A.is_divided() && linalg::is_shared_work(T_.cols())) {
      const fem::Following rows = T_;
      return fem::matrix_made_elsewhere(which, full_->blocks, {full_->nodes, full_->dofs}, order_,
                                        &rows);
    }
    if (A.nodes() != nullptr || A.blocks() != nullptr) return condensed(A.copied());
    return condensed(A.whole());
  }
  /// Component `axis` of the displacements of all nodes, a row each.
  SparseMatrix component(std::size_t axis) const {
    std::vector<Triplet> entries;
    for (std::size_t node = 0; node < full_->nodes.size(); ++node) {
      const int dof = full_->dofs.node_dofs[node][axis];
      if (dof >= 0) entries.emplace_back(static_cast<int>(node), dof, 1.0);
    }
    SparseMatrix pick(static_cast<Eigen::Index>(full_->nodes.size()), T_.rows());
    pick.setFromTriplets(entries.begin(), entries.end());
    return pick * T_;
  }

 private:
  const fem::FeModel* full_;
  std::vector<fem::Node> nodes_;
  fem::NodeParts parts_;
  linalg::SharedRowOrder order_;
  fem::Elimination elimination_;
  SparseMatrix T_;
};

/// Splits the scalar mass matrix: entries between free nodes stay, all others become W_ab.
void condense_nodal_mass(const fem::NodalMass& full, const Condensation& elimination,
                         fem::ShapeIntegrals& out) {
  std::vector<Triplet> kept, taken;
  for (int column = 0; column < full.Ms->outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(*full.Ms, column); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      const bool is_free =
          elimination.is_free(row) && elimination.is_free(static_cast<std::size_t>(column));
      (is_free ? kept : taken).emplace_back(static_cast<int>(it.row()), column, it.value());
    }
  }
  const auto num_nodes = static_cast<Eigen::Index>(elimination.nodes().size());
  SparseMatrix Ms(num_nodes, num_nodes);
  Ms.setFromTriplets(kept.begin(), kept.end());
  out.nodal.Ms = linalg::SharedMatrix(std::move(Ms));
  for (const auto& node : elimination.dofs().node_dofs) {
    out.nodal.dofs.push_back({node[0], node[1], node[2]});
  }
  SparseMatrix rest(full.Ms->rows(), full.Ms->cols());
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

fem::ShapeIntegrals condensed(const fem::ShapeIntegrals& full, const Condensation& elimination) {
  fem::ShapeIntegrals out;
  out.mass = full.mass;
  out.com = full.com;
  out.C0 = full.C0;
  out.J0 = full.J0;
  out.c = elimination.T().transpose() * full.c;
  for (std::size_t k = 0; k < out.W.size(); ++k) out.W[k] = elimination.condensed(full.W[k]);
  if (!full.nodal.empty()) {
    condense_nodal_mass(full.nodal, elimination, out);
  }
  return out;
}

/// The mesh with its links solved.
fem::FeModel condensed(const fem::FeModel& full, const Condensation& elimination) {
  fem::FeModel fe;
  fe.nodes = elimination.nodes();
  fe.dofs = elimination.dofs();
  fe.parts = elimination.parts();
  fe.M = elimination.condensed(fem::MeshMatrix::mass, full.M);
  fe.K = elimination.condensed(fem::MeshMatrix::stiffness, full.K);
  fe.K_damping = elimination.condensed(fem::MeshMatrix::damping, full.K_damping);
  fe.mass_damping = full.mass_damping;
  fe.damps_held_motion = full.damps_held_motion;
  fe.shape = condensed(full.shape, elimination);
  return fe;
}

}  // namespace

LinkedPart with_links(const std::string& body, FlexiblePart& part,
                      const std::vector<RigidRegion>& regions, const fem::NodeLinks& links) {
  linalg::Matrix first_moments = part.invariants.first_moments();
  auto full = std::make_shared<fem::FeModel>(std::move(part.fe));
  full->shape.c = std::move(first_moments);
  refuse_common_nodes(body, full->nodes.size(), regions);
  Condensation elimination(*full, regions, links);
  fem::FeModel fe = condensed(*full, elimination);
  LinkedPart out;
  const std::vector<LooseMotion> loose =
      links.empty() ? std::vector<LooseMotion>{} : loose_motions(fe);
  if (!loose.empty()) {
    fem::NodeLinks more = links;
    for (fem::LinearEquation& equation : follow_nearest(body, *full, loose)) {
      more.equations.push_back(std::move(equation));
    }
    elimination = Condensation(*full, regions, more);
    fe = {};  // its matrices make room
    fe = condensed(*full, elimination);
    out.note = loose_motions_note(*full, loose);
  }
  out.part = std::make_unique<FlexiblePart>(body, std::move(fe), part.coupling);
  // Steps need M of the full mesh, for coordinates of given displacements, but nothing else.
  full->K = {};
  full->K_damping = {};
  full->shape.c = {};
  out.part->full_mesh = std::move(full);
  out.part->recovery = NodalRecovery(elimination.T());
  return out;
}

}  // namespace buckens::body
