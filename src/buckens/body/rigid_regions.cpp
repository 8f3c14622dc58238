// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/rigid_regions.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/second_moments.h"
#include "buckens/fem/constraint/elimination.h"
#include "buckens/fem/element/node_label.h"

namespace buckens::body {

using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

// Share of a node's mass that a motion of it must have: rounding stays below 1e-15, nodes that are
// nearly on a line above 1e-10.
constexpr double kMassless = 1e-12;

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
          "in common, which cannot move with both; make one of them `average`, or join them to one",
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
      : full_(full), nodes_(full.nodes) {
    fem::DofMap dofs = full.dofs;
    const std::array<bool, 6> known = known_variables(full.dofs);
    for (const RigidRegion& region : regions) {
      links.rigid.push_back({fmt::format("rigid interface \"{}\"", region.name),
                             static_cast<int>(nodes_.size()), region.nodes});
      nodes_.push_back({region.name, region.centre});
      auto& own = dofs.node_dofs.emplace_back();
      for (std::size_t k = 0; k < 6; ++k) own[k] = known[k] ? dofs.num_dofs++ : -1;
    }
    elimination_ = fem::eliminate(nodes_, dofs, links);
    T_ = elimination_.T.topRows(full.dofs.num_dofs);
    T_.makeCompressed();
  }

  const std::vector<fem::Node>& nodes() const { return nodes_; }
  const fem::DofMap& dofs() const { return elimination_.dofs; }
  const SparseMatrix& T() const { return T_; }
  bool is_free(std::size_t node) const { return elimination_.is_free[node]; }
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
  const fem::FeModel& full_;
  std::vector<fem::Node> nodes_;
  fem::Elimination elimination_;
  SparseMatrix T_;
};

/// Splits the scalar mass matrix: entries between free nodes stay, all others become W_ab.
void condense_nodal_mass(const fem::NodalMass& full, const Condensation& elimination,
                         fem::ShapeIntegrals& out) {
  std::vector<Triplet> kept, taken;
  for (int column = 0; column < full.Ms.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(full.Ms, column); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      const bool is_free =
          elimination.is_free(row) && elimination.is_free(static_cast<std::size_t>(column));
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

fem::ShapeIntegrals condensed(const fem::ShapeIntegrals& full, const Condensation& elimination) {
  fem::ShapeIntegrals out;
  out.mass = full.mass;
  out.com = full.com;
  out.C0 = full.C0;
  out.J0 = full.J0;
  out.c = elimination.T().transpose() * full.c;
  for (std::size_t k = 0; k < out.W.size(); ++k) out.W[k] = elimination.condensed(full.W[k]);
  if (full.nodal.Ms.nonZeros() > 0) {
    condense_nodal_mass(full.nodal, elimination, out);
  }
  return out;
}

/// The entries of a symmetric matrix between these variables.
Eigen::MatrixXd block_of(const SparseMatrix& A, const std::vector<int>& variables) {
  const auto count = static_cast<Eigen::Index>(variables.size());
  Eigen::MatrixXd out(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      out(i, j) =
          A.coeff(variables[static_cast<std::size_t>(i)], variables[static_cast<std::size_t>(j)]);
    }
  }
  return out;
}

/// Motions of a node that move no mass, orthonormal in the variables that have some, a column each.
Eigen::MatrixXd massless_motions(const Eigen::MatrixXd& M) {
  const Eigen::Index count = M.rows();
  // Variables without mass stand for themselves.
  const Eigen::VectorXd size =
      (M.diagonal().array() > 0.0).select(M.diagonal().cwiseSqrt(), Eigen::VectorXd::Ones(count));
  const Eigen::MatrixXd scaled =
      size.cwiseInverse().asDiagonal() * M * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  Eigen::Index num_massless = 0;
  while (num_massless < count && solver.eigenvalues()[num_massless] < kMassless) ++num_massless;
  return size.cwiseInverse().asDiagonal() * solver.eigenvectors().leftCols(num_massless);
}

/// Refuses variables that move neither mass nor an element: a reference node whose links leave it a
/// free motion. If elements resist, as ends of massless beams do, the motion follows.
void refuse_massless(const std::string& body, const fem::FeModel& fe) {
  for (std::size_t node = 0; node < fe.dofs.node_dofs.size(); ++node) {
    std::vector<int> own;
    for (const int dof : fe.dofs.node_dofs[node]) {
      if (dof >= 0) own.push_back(dof);
    }
    if (own.empty()) continue;
    const Eigen::MatrixXd Z = massless_motions(block_of(fe.M, own));
    if (Z.cols() == 0) continue;
    const Eigen::MatrixXd K = block_of(fe.K, own);
    const Eigen::VectorXd size =
        (K.diagonal().array() > 0.0)
            .select(K.diagonal().cwiseSqrt(), Eigen::VectorXd::Ones(K.rows()));
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(size.asDiagonal() * Z);
    const Eigen::MatrixXd motions =
        qr.householderQ() * Eigen::MatrixXd::Identity(Z.rows(), Z.cols());
    const Eigen::MatrixXd scaled =
        size.cwiseInverse().asDiagonal() * K * size.cwiseInverse().asDiagonal();
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                             motions.transpose() * scaled * motions, Eigen::EigenvaluesOnly)
                             .eigenvalues()[0];
    if (least > kMassless) continue;
    throw ModelError(fmt::format(
        "body \"{}\": {} can move or turn without moving any mass, since what is linked to it does "
        "not hold it in all directions; link nodes that span a surface, or nodes with rotations, "
        "or give it a point mass with inertia",
        body, fem::node_label(fe.nodes, static_cast<int>(node))));
  }
}

}  // namespace

std::unique_ptr<FlexiblePart> with_links(const std::string& body, FlexiblePart& part,
                                         const std::vector<RigidRegion>& regions,
                                         const fem::NodeLinks& links) {
  auto full = std::make_shared<const fem::FeModel>(std::move(part.fe));
  refuse_common_nodes(body, full->nodes.size(), regions);
  const Condensation elimination(*full, regions, links);
  fem::FeModel fe;
  fe.nodes = elimination.nodes();
  fe.dofs = elimination.dofs();
  fe.M = elimination.condensed(full->M);
  fe.K = elimination.condensed(full->K);
  fe.K_damping = elimination.condensed(full->K_damping);
  fe.mass_damping = full->mass_damping;
  fe.damps_held_motion = full->damps_held_motion;
  fe.shape = condensed(full->shape, elimination);
  if (!links.empty()) refuse_massless(body, fe);
  auto out = std::make_unique<FlexiblePart>(body, std::move(fe), part.coupling);
  out->full_mesh = std::move(full);
  out->recovery = NodalRecovery(elimination.T());
  return out;
}

}  // namespace buckens::body
